"""Materials by their names, from a file of them or from a case."""
import os

import yaml

from resolved_case import Refused


def read_yaml(path):
    """A file of YAML, a map."""
    try:
        found = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as reason:
        raise Refused(66, f"{path}: cannot be read: {reason}") from None
    except yaml.YAMLError as reason:
        raise Refused(65, f"{path}: is no YAML: {' '.join(str(reason).split())}") from None
    if not isinstance(found, dict):
        raise Refused(65, f"{path}: must be a map of materials, or a case")
    return found


def known_materials(wish):
    """Materials by name, and the case that the new one is to be like, its records found from where the new one will stand."""
    like = read_yaml(wish.like) if wish.like else {}
    own = read_yaml(wish.materials) if wish.materials else {}
    materials = {**(like.get("materials") or {}), **(own.get("materials") or own)}
    if not materials or not all(isinstance(value, dict) for value in materials.values()):
        raise Refused(65, f"{wish.materials or wish.like}: holds no materials, as 'clay: {{model: von_mises, ...}}'")
    motion = (like.get("seismic") or {}).get("motion") or {}
    for record in (motion.get(direction) for direction in ("horizontal", "vertical")):
        if isinstance(record, dict) and "file" in record:
            record["file"] = os.path.relpath(wish.like.parent / record["file"], wish.out)
    return {str(name): value for name, value in materials.items()}, like


def material_of(name, materials, renamed):
    """The material of a layer: that of --layer, or of the same name but for upper and lower case."""
    wanted = renamed.get(name.casefold(), name)
    found = [known for known in materials if known == wanted] or [known for known in materials if known.casefold() == wanted.casefold()]
    return found[0] if len(found) == 1 else None
