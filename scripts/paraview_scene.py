"""What paraview-state has pvbatch do: builds the scene that JSON describes (paraview_state.scene_of), saves its state and picture."""
import json
import sys

from paraview import simple

WIDTH = 1400  # pixels


def build(scene):
    """The view of the particles."""
    frames = simple.OpenDataFile(scene["series"])
    view = simple.CreateRenderView()
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.GetAnimationScene().AnimationTime = scene["time"]
    width, height = (high - low for low, high in zip(scene["low"], scene["high"]))
    view.ViewSize = [WIDTH, max(350, int(WIDTH * (1.1 * height / width + 0.08)))]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    shown = simple.Show(frames, view)
    shown.SetRepresentationType("Point Gaussian")
    shown.GaussianRadius = scene["radius"]
    shown.ShaderPreset = "Plain circle"
    simple.ColorBy(shown, ("POINTS", scene["field"]))
    colours = simple.GetColorTransferFunction(scene["field"])
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(*scene["range"])
    colours.AutomaticRescaleRangeMode = "Never"
    shown.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = scene["field"].replace("_", " "), ""
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.RangeLabelFormat = bar.LabelFormat = "%.3g"
    bar.WindowLocation = "Upper Right Corner"
    time = simple.Show(simple.AnnotateTimeFilter(frames, Format="t = {time:.2f} s"), view)
    time.Color = [0.0, 0.0, 0.0]
    time.WindowLocation = "Upper Left Corner"
    view.InteractionMode = "2D"
    middle = [0.5 * (low + high) for low, high in zip(scene["low"], scene["high"])]
    view.CameraPosition, view.CameraFocalPoint = [*middle, width], [*middle, 0.0]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.52 * width * view.ViewSize[1] / WIDTH
    return view


def main():
    """Saves both."""
    scene = json.loads(sys.argv[1])
    view = build(scene)
    simple.SaveScreenshot(scene["picture"], view)
    simple.SaveState(scene["state"])


main()
