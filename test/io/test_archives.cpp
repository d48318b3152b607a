// Formats of public archives, in texts made for the tests.

#include "test/io/record_samples.hpp"
#include "test/io/record_texts.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Contains;

namespace
{
std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}
} // namespace

TEST_CASE("each archive's format is read, under its own name and as auto", "[io]")
{
  for (Sample sample : samples())
  {
    INFO(sample.name + " " + sample.source.file);
    for (std::string format : {std::string("auto"), sample.name})
    {
      sample.source.format = format;
      const Record record = parse_record(sample.text, sample.source);
      CHECK(record.format == sample.name);
      CHECK(record.dt == Approx(sample_dt).epsilon(1e-15));
      CHECK(record.quantity == Quantity::acceleration);
      REQUIRE(record.values.size() == sample_count);
      double mean = 0, error = 0; // K-NET's offset takes a mean with it
      if (sample.name == "knet")
        for (int i = 0; i < sample_count; ++i) mean += sample_value(i) / sample_count;
      for (int i = 0; i < sample_count; ++i)
        error = std::max(error, std::abs(record.values[std::size_t(i)] - (sample_value(i) - mean) / 100));
      // The coarsest print is GeoNet's 0.1 mm/s2, then V1's 1e-6 g and CWB's 0.001 gal, then 5 digits of up
      // to 80 cm/s2.
      CHECK(error < (sample.name == "geonet" ? 6e-5 : 1.1e-5));
    }
    sample.source.dt = 0.02;
    CHECK_THAT(refusal(sample.text, sample.source),
               Contains("0.01 s and the case") || Contains("a time step of 0.01 s"));
    sample.source.dt = 0.01;
    sample.source.unit = "ft/s2";
    CHECK_THAT(refusal(sample.text, sample.source), Contains("the case says ft/s2"));
    sample.source.unit = "";
    sample.source.component = "N77W";
    CHECK_THAT(refusal(sample.text, sample.source), Contains("N77W"));
  }
}

TEST_CASE("a file of several components wants one named, and the record tells it", "[io]")
{
  for (Sample sample : {cosmos_sample(), csmip_sample(), cwb_sample(), geonet_sample(), bhrc_sample()})
  {
    INFO(sample.name);
    CHECK_THAT(parse_record(sample.text, sample.source).component, Contains(sample.source.component));
    sample.source.component = "";
    CHECK_THAT(refusal(sample.text, sample.source), Contains("holds the components"));
  }
  Sample cwb = cwb_sample();
  cwb.source.component = "vertical";
  CHECK(parse_record(cwb.text, cwb.source).component == "U");
  CHECK(parse_record(knet_sample().text, knet_sample().source).component == "E-W");
}

TEST_CASE("what an archive's header says is checked against its values", "[io]")
{
  const auto refused = [](const Sample& sample, const std::string& from, const std::string& to)
  {
    INFO(sample.name << ": " << from << " -> " << to);
    CHECK_THAT(refusal(replaced(sample.text, from, to), sample.source), Contains(sample.source.file));
  };
  refused(knet_sample(), "Duration Time(s)  4", "Duration Time(s)  5");
  refused(knet_sample(), "2000(gal)", "3000(gal)");
  refused(knet_sample(), "Sampling Freq(Hz) 100Hz", "Sampling Freq(Hz) 200Hz");
  refused(knet_sample(), "Dir.              E-W", "Dir.              7");
  refused(esm_sample(), "NDATA: 400", "NDATA: 399");
  refused(esm_sample(), "UNITS: cm/s^2", "UNITS: g");
  refused(esm_sample(), "UNITS: cm/s^2", "UNITS: cubits");
  refused(esm_sample(), "DATA_TYPE: ACCELERATION", "DATA_TYPE: VELOCITY");
  refused(esm_sample(), "INTERVAL_S: 0.010000", "INTERVAL_S: 0.005000");
  refused(smc_sample(), "2 CORRECTED ACCELEROGRAM", "1 UNCORRECTED ACCELEROGRAM");
  refused(smc_sample(), "2 CORRECTED ACCELEROGRAM", "6 RESPONSE SPECTRA");
  refused(smc_sample(), "       400", "       390");
  refused(cosmos_sample(), "    400  acc", "    392  acc");
  refused(cosmos_sample(), "units=cm/sec2", "units=g");
  refused(cosmos_sample(), "units=cm/sec2", "units=counts");
  refused(cosmos_sample(), "approx    4 secs", "approx   40 secs");
  refused(csmip_sample(), "   400 points of accel", "   392 points of accel");
  refused(csmip_sample(), ", in cm/sec2.", ", in g.");
  refused(csmip_raw_sample(), "units of g .      F", "units of gal .      F");
  refused(csmip_raw_sample(), "points at 100 pts", "points at 1OO pts");
  refused(cwb_sample(), "gal. DC", "cm/s. DC");
  refused(cwb_sample(), "SampleRate(Hz): 100", "SampleRate(Hz): 200");
  refused(cwb_sample(), "N(+)", "N(-)");
  refused(geonet_sample(), "at 0.010 sec", "at 0.020 sec");
  refused(geonet_sample(), "Number of points   400", "Number of points   390");
  refused(bhrc_sample(), "G/10", "G/9");
  refused(bhrc_sample(), "DURATION =   4.000", "DURATION =   8.000");
}

TEST_CASE("a borehole's record of KiK-net is refused for what it is, one of the surface is read", "[io]")
{
  Sample sample = knet_sample();
  for (std::string direction : {"1", "2", "3"})
    CHECK_THAT(refusal(replaced(sample.text, "E-W", direction), sample.source), Contains("borehole"));
  const std::vector<std::pair<std::string, std::string>> surface{{"4", "N-S"}, {"5", "E-W"}, {"6", "U-D"}};
  for (const auto& [direction, component] : surface)
    CHECK(parse_record(replaced(sample.text, "E-W", direction), sample.source).component == component);
}

TEST_CASE("a format that the case names wrongly is refused with the right one", "[io]")
{
  for (Sample sample : {knet_sample(), cwb_sample(), smc_sample()})
    for (std::string format : {"column", "two_column", "peer", "geonet"})
    {
      sample.source.format = format;
      CHECK_THAT(refusal(sample.text, sample.source), Contains("; use format: " + sample.name));
    }
  CHECK_THAT(refusal("1\n2\n", {"r.txt", "knet", 0.01, "g", {}}), Contains("is not of the format knet"));
}

TEST_CASE("formats that are not read are refused by their name", "[io]")
{
  const std::vector<std::pair<std::string, std::string>> samples{
      {"STRONG GROUND MOTION RECORDS OF TURKIYE\nSAMPLING INTERVAL (sec) : 0.01\n N-S E-W U-D\n1 2 3\n",
       "AFAD"},
      {"CORRECTED ACCELEROGRAM\nFILE 0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\nUNITS ARE SEC AND "
       "G/10\n",
       "USC"},
      {"file: 2.cor\nsampling period: 0.01s\nnumber of samples: 3\nunits: m/s*s\n1 2 3\n", "ISESD"},
      {"SIMBAD database\n1 2\n", "SIMBAD"},
      {"Option 3 -- input motion of SHAKE\n 3 4096 .02 acc (8f10.6)\n", "SHAKE"},
      {"1 2 3\n4 5 6\n", "3 numbers a line"},
      {"<!DOCTYPE html>\n<html>\n", "HTML"},
      {std::string("\0\1\2\0", 4), "binary"},
      {"", "empty"},
      {"no record\n", "no line of numbers"}};
  for (const auto& [text, name] : samples) CHECK_THAT(refusal(text, {.file = "r.dat"}), Contains(name));
}
