// A run is what its folder says: finished only while every file is there and whole, gone on with from the
// best state there is, and never from one that no run can have left.

#include "test/sealed.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

#include <functional>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
const Arguments brief{"--set", "seismic.duration=0.3 s"};

void copy_folder(const fs::path& from, const fs::path& to)
{
  fs::remove_all(to);
  fs::copy(from, to);
}

/// A finished static run and a finished brief seismic one.
struct Finished : Bench
{
  Finished()
  {
    make_static();
    const Ending ending = run_seismic("whole", brief);
    INFO(ending.said);
    REQUIRE(ending.code == 0);
  }
  Ending again(const std::string& out) const { return run_seismic(out, brief); }
};

/// A run that has two checkpoints and was stopped.
struct Stopped : Finished
{
  Stopped()
  {
    const Arguments arguments = seismic_arguments("stopped", brief);
    Arguments often = arguments;
    often.insert(often.end(), {"--set", "output.checkpoint.every=1 ms"});
    kill_after_checkpoints(*this, "mpm-seismic", often, *this / "stopped", 2);
    REQUIRE(checkpoints(*this / "stopped").size() == 2);
  }
};

template <class T>
void write_values(hid_t file, const std::string& name, hid_t type,
                  const std::function<void(std::vector<T>&)>& change)
{
  const h5::Handle data{H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose};
  REQUIRE(data.id() >= 0);
  const h5::Handle space{H5Dget_space(data.id()), H5Sclose};
  std::vector<T> values(std::size_t(H5Sget_simple_extent_npoints(space.id())));
  REQUIRE(H5Dread(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  change(values);
  REQUIRE(H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
}

void set_doubles(hid_t file, const std::string& name, const std::function<void(std::vector<double>&)>& change)
{
  write_values<double>(file, name, H5T_NATIVE_DOUBLE, change);
}
void set_integers(hid_t file, const std::string& name,
                  const std::function<void(std::vector<std::int64_t>&)>& change)
{
  write_values<std::int64_t>(file, name, H5T_NATIVE_INT64, change);
}

/// Fewer values than there were.
void shorten(hid_t file, const std::string& name)
{
  REQUIRE(H5Ldelete(file, name.c_str(), H5P_DEFAULT) >= 0);
  const hsize_t few = 3;
  const h5::Handle space{H5Screate_simple(1, &few, nullptr), H5Sclose};
  const h5::Handle data{
      H5Dcreate2(file, name.c_str(), H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose};
  const double values[3] = {};
  REQUIRE(H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
}

template <class T>
void set_attribute(hid_t file, const std::string& of, const std::string& name, hid_t type, T value)
{
  REQUIRE(H5Adelete_by_name(file, of.c_str(), name.c_str(), H5P_DEFAULT) >= 0);
  const h5::Handle space{H5Screate(H5S_SCALAR), H5Sclose};
  const h5::Handle attribute{H5Acreate_by_name(file, of.c_str(), name.c_str(), type, space.id(), H5P_DEFAULT,
                                               H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose};
  REQUIRE(H5Awrite(attribute.id(), type, &value) >= 0);
}

struct Wrong
{
  std::string what;
  std::function<void(hid_t)> make;
};

/// States that are well-formed, sealed, and yet no run's.
std::vector<Wrong> wrong_states()
{
  const auto real = [](const std::string& of, const std::string& name, double value) {
    return Wrong{of + "@" + name, [=](hid_t f) { set_attribute(f, of, name, H5T_NATIVE_DOUBLE, value); }};
  };
  const auto whole = [](const std::string& of, const std::string& name, std::int64_t value) {
    return Wrong{of + "@" + name, [=](hid_t f) { set_attribute(f, of, name, H5T_NATIVE_INT64, value); }};
  };
  const auto doubles = [](const std::string& name, double value) {
    return Wrong{name, [=](hid_t f) { set_doubles(f, name, [&](auto& v) { v[v.size() / 2] = value; }); }};
  };
  const auto integers = [](const std::string& name, std::int64_t value) {
    return Wrong{name, [=](hid_t f) { set_integers(f, name, [&](auto& v) { v[v.size() / 2] = value; }); }};
  };
  const auto fewer = [](const std::string& name) {
    return Wrong{name + " short", [=](hid_t f) { shorten(f, name); }};
  };
  return {
      real("clock", "dt", -0.001),
      real("clock", "dt", NAN),
      real("clock", "dt", 0.0007),
      real("clock", "dt", 0),
      real("clock", "time", 0.0101),
      real("clock", "start_time", -1),
      whole("clock", "step", std::int64_t(1) << 62),
      whole("clock", "step", -3),
      whole("clock", "start_step", 1000000),
      doubles("particles/stress", NAN),
      doubles("particles/velocity", INFINITY),
      doubles("particles/position", 1e300),
      doubles("particles/position", -500),
      doubles("particles/mass", -1),
      doubles("particles/mass", 7),
      doubles("particles/volume", 0),
      integers("particles/id", 0),
      integers("particles/id", -1),
      integers("particles/id", 1 << 30),
      fewer("particles/volume"),
      fewer("materials/clay/plastic_strain"),
      doubles("materials/clay/plastic_strain", NAN),
      doubles("materials/clay/plastic_strain", -0.1),
      {"grid/occupied_blocks far",
       [](hid_t f) { set_integers(f, "grid/occupied_blocks", [](auto& v) { v[0] = 1 << 30; }); }},
      {"grid/occupied_blocks elsewhere",
       [](hid_t f) { set_integers(f, "grid/occupied_blocks", [](auto& v) { v[0] -= 3; }); }},
      {"grid/occupied_blocks material",
       [](hid_t f) { set_integers(f, "grid/occupied_blocks", [](auto& v) { v[2] = 9; }); }},
      {"grid/occupied_blocks begin",
       [](hid_t f) { set_integers(f, "grid/occupied_blocks", [](auto& v) { v[3] = -4; }); }},
      {"grid/occupied_blocks end",
       [](hid_t f) { set_integers(f, "grid/occupied_blocks", [](auto& v) { v[4] -= 1; }); }},
      {"grid/occupied_blocks wide", [](hid_t f)
       { set_integers(f, "grid/occupied_blocks", [](auto& v) { v[0] = (std::int64_t(1) << 32); }); }},
      real("grid", "drift", -0.1),
      real("grid", "drift", 3),
      real("grid", "spacing", 0.5),
      integers("boundary/images/image_parent", -7),
      integers("boundary/images/image_parent", 1 << 20),
      integers("boundary/images/image_parent", (std::int64_t(1) << 40) + 3),
      integers("boundary/images/image_load", 1 << 20),
      integers("boundary/images/image_load", (std::int64_t(1) << 32) + 1),
      integers("boundary/images/image_block_x", 50),
      doubles("boundary/images/image_offset_x", 1e9),
      doubles("boundary/images/image_load_stress_xx", NAN),
      fewer("boundary/images/image_load_weight_y"),
      integers("boundary/base/face_particle", 1 << 20),
      integers("boundary/base/face_particle", -1),
      doubles("boundary/base/face_offset_y", 1e12),
      doubles("boundary/base/face_dashpot_x", -1),
      fewer("boundary/base/spring_reaction_y"),
      integers("boundary/left/ghost_parent", 1 << 20),
      fewer("boundary/right/static_stress_volume_xy"),
      doubles("energy/work", NAN),
      fewer("rest/settings"),
      doubles("rest/settings", -1),
      fewer("gauges/x"),
      doubles("gauges/velocity_x", NAN),
      doubles("free_field/left/particles/stress", NAN),
      doubles("output/history/gauges/time", -1),
      fewer("output/history/gauges/time"),
      doubles("output/frame_times", 77),
      fewer("output/gauge_velocity"),
      fewer("output/slide/departure"),
      fewer("output/slide/peaks"),
      real("output", "gauge_time", 5),
      real("motion", "decided", 17),
  };
}
} // namespace

TEST_CASE("a finished run of which a file is lost or damaged is finished no more, and never silently",
          "[stages]")
{
  const Finished bench;
  const auto damage = GENERATE(0, 1);
  for (const auto& entry : fs::directory_iterator(bench / "whole"))
  {
    const std::string name = entry.path().filename();
    if (name == "log.txt" || name == ".lock" || name == "identity.json") continue;
    copy_folder(bench / "whole", bench / "hurt");
    damage ? flip_a_bit(bench / ("hurt/" + name)) : void(fs::remove(bench / ("hurt/" + name)));
    const Ending ending = bench.again("hurt");
    INFO(name << (damage ? " damaged\n" : " lost\n") << ending.said);
    if (name.starts_with("frame-"))
    {
      CHECK(ending.code == 73);
      CHECK_THAT(ending.said, Contains(name) && Contains("--fresh"));
      CHECK_FALSE(fs::exists(bench / "hurt/finished.json"));
      continue;
    }
    CHECK(ending.code == 0);
    CHECK(ending.said.find("finished already") == std::string::npos);
    CHECK((ending.said.find("starts from the beginning") != std::string::npos) ==
          (damage && name == "final.h5"));
    fs::remove(bench / "hurt/final.h5.unusable");
    check_same_results(bench / "whole", bench / "hurt");
    CHECK_THAT(contents(bench / "hurt/summary.json"), Contains("\"exit\": 0"));
    CHECK_THAT(bench.again("hurt").said, Contains("finished already"));
  }
}

TEST_CASE("a final state that is whole is gone on from, and stays to the byte", "[stages]")
{
  const Finished bench;
  for (const std::string out : {"whole", "static"})
  {
    fs::remove(bench / (out + "/finished.json"));
    fs::remove(bench / (out + "/summary.json"));
    const std::string before = contents(bench / (out + "/final.h5"));
    const Ending ending = out == "static" ? bench.run_static("static") : bench.again("whole");
    INFO(ending.said);
    CHECK(ending.code == 0);
    CHECK_THAT(ending.said, Contains("goes on from"));
    CHECK(contents(bench / (out + "/final.h5")) == before);
    CHECK_THAT(contents(bench / (out + "/summary.json")), Contains("\"exit\": 0"));
  }
}

TEST_CASE("a run takes no state of another run, of another stage or that is not its last for its end",
          "[stages]")
{
  const Stopped bench;
  fs::copy(bench / "static/final.h5", bench / "stopped/final.h5"); // another stage's
  Ending ending = bench.again("stopped");
  INFO(ending.said);
  CHECK(ending.code == 0);
  CHECK_THAT(ending.said, Contains("is of another run") && Contains("goes on from"));
  fs::remove(bench / "stopped/final.h5.unusable");
  check_same_results(bench / "whole", bench / "stopped");

  terminate(bench, "mpm-seismic", bench.seismic_arguments("other", {"--set", "seismic.duration=1 s"}),
            bench / "other"); // another run's checkpoint, and a checkpoint under the name of the end
  fs::create_directory(bench / "mine");
  for (const char* name : {"identity.json", "frame-00000.hdf"})
    fs::copy(bench / "whole" / name, bench / "mine" / name);
  fs::copy(checkpoints(bench / "other").back(), bench / "mine/checkpoint-000000001.h5");
  fs::copy(checkpoints(bench / "other").back(), bench / "other/final.h5");
  ending = bench.again("mine");
  CHECK(ending.code == 0);
  CHECK_THAT(ending.said, Contains("is of another run") && Contains("starts from the beginning"));
  ending = bench.run_seismic("other", {"--set", "seismic.duration=1 s", "--max-wall", "0.01 s"});
  CHECK(ending.code == 75);
  CHECK_THAT(ending.said, Contains("is not the last state"));
}

TEST_CASE("states that are well-formed and yet no run's are passed over for the older one, and told",
          "[stages]")
{
  const Stopped bench;
  for (const Wrong& wrong : wrong_states())
  {
    copy_folder(bench / "stopped", bench / "mended");
    edit_sealed(checkpoints(bench / "mended").back(), [&](const h5::Handle& file) { wrong.make(file.id()); });
    const Ending ending = bench.again("mended");
    INFO(wrong.what << "\n" << ending.said);
    CHECK(ending.code == 0);
    CHECK(ending.said.find("trying an older one") != std::string::npos);
    CHECK_THAT(ending.said, Contains("goes on from"));
    for (const auto& entry : fs::directory_iterator(bench / "mended"))
      if (entry.path().extension() == ".unusable") fs::remove(entry.path());
    check_same_results(bench / "whole", bench / "mended");
  }
}

TEST_CASE("without a state that is whole a run starts from the beginning, and says so", "[stages]")
{
  const Stopped bench;
  for (const fs::path& checkpoint : checkpoints(bench / "stopped")) flip_a_bit(checkpoint);
  const Ending ending = bench.again("stopped");
  INFO(ending.said);
  CHECK(ending.code == 0);
  CHECK_THAT(ending.said, Contains("starts from the beginning"));
  CHECK_THAT(contents(bench / "stopped/summary.json"), Contains("starts from the beginning"));
  CHECK(checkpoints(bench / "stopped").empty());
  for (const auto& entry : fs::directory_iterator(bench / "stopped"))
    if (entry.path().extension() == ".unusable") fs::remove(entry.path());
  check_same_results(bench / "whole", bench / "stopped");
}

TEST_CASE("a damaged checkpoint does not push the good ones out", "[stages]")
{
  const Stopped bench;
  const fs::path bad = bench / "stopped/checkpoint-000999999.h5";
  put(bad, "damaged");
  const Ending ending = bench.run_seismic("stopped", {"--set", "seismic.duration=0.3 s", "--set",
                                                      "output.checkpoint.keep=1", "--max-wall", "0.01 s"});
  INFO(ending.said);
  CHECK(ending.code == 75);
  REQUIRE(checkpoints(bench / "stopped").size() == 1);
  CHECK(code_of([&] { open_complete(checkpoints(bench / "stopped").back()); }) == 0);
  CHECK_FALSE(fs::exists(bad));
}
