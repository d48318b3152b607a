#pragma once
// Made files in the formats of archives, all of one motion; their layout is that of real ones.

#include "io/records/reader.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace mpm::test
{
/// A made file and how it is to be read.
struct Sample
{
  std::string name; ///< of the format, as the record tells it
  RecordSource source;
  std::string text;
};

inline constexpr int sample_count = 400;
inline constexpr double sample_dt = 0.01;

template <class... Values>
std::string print(const char* format, Values... values)
{
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// cm/s2, with 4 digits behind the point: a wave packet of 80 cm/s2, other for each component.
inline double sample_value(int i, int component = 0)
{
  const double t = sample_dt * i, phase = 6.5 * t * (1 + 0.3 * component) + component;
  return std::round(1e4 * 80 * std::exp(-std::pow((t - 1.9) / 0.7, 2)) * std::sin(phase)) / 1e4;
}
inline double sample_peak(int component = 0)
{
  double peak = 0;
  for (int i = 0; i < sample_count; ++i)
    if (std::abs(sample_value(i, component)) > std::abs(peak)) peak = sample_value(i, component);
  return peak;
}

/// All values times `factor`, `per_line` on a line.
inline std::string body(const char* format, int per_line, double factor = 1, int component = 0)
{
  std::string text;
  for (int i = 0; i < sample_count; ++i)
    text += print(format, factor * sample_value(i, component)) +
            (i % per_line == per_line - 1 || i == sample_count - 1 ? "\n" : "");
  return text;
}

/// `lines` lines of `per_line` fields of `width`, all 0 but those given by their numbers from 1.
inline std::string header_numbers(int count, int per_line, const char* format, double usual,
                                  const std::vector<std::pair<int, double>>& given)
{
  std::string text;
  for (int i = 1; i <= count; ++i)
  {
    double value = usual;
    for (const auto& [at, other] : given)
      if (at == i) value = other;
    text += print(format, value) + (i % per_line == 0 || i == count ? "\n" : "");
  }
  return text;
}

inline Sample peer_sample()
{
  return {"peer",
          {.file = "r.txt"},
          "PEER STRONG MOTION DATABASE RECORD\nMADE EVENT 01/01/01, STATION 7, 090\n"
          "ACCELERATION TIME HISTORY IN UNITS OF CM/S/S\nNPTS=   400, DT= .01000 SEC\n" +
              body("%15.6E", 5)};
}

/// As Fortran's E15.7 prints it, without a leading zero: "  -.1480064E-03".
inline std::string fortran(double value)
{
  const int power = value == 0 ? 0 : int(std::floor(std::log10(std::abs(value)) + 1e-9)) + 1;
  std::string mantissa = print("%.7f", std::abs(value) / std::pow(10, power)).substr(1);
  return print("%15s", ((value < 0 ? "-" : "") + mantissa + print("E%+03d", power)).c_str());
}

inline Sample at2_sample()
{
  std::string values;
  for (int i = 0; i < sample_count; ++i)
    values += fortran(sample_value(i) / 980.665) + (i % 5 == 4 ? "\n" : "");
  return {"peer",
          {.file = "r.AT2"},
          "PEER NGA STRONG MOTION DATABASE RECORD\nMade, 1/1/2001, Station 7, 90\n"
          "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=    400, DT=   .0100 SEC,            \n" +
              values};
}

inline Sample column_sample()
{
  return {
      "column", {.file = "r.txt"}, "# Sampling rate: 100 Hz\nacceleration (cm/s2)\n400\n" + body("%.4f", 1)};
}

inline Sample table_sample()
{
  std::string text = "# a made record\ntime (s), NS (cm/s2), EW (cm/s2)\n";
  for (int i = 0; i < sample_count; ++i)
    text += print("%.2f, %.4f, %.4f\n", sample_dt * i, sample_value(i), sample_value(i, 1));
  return {"two_column", {.file = "r.csv", .component = "NS"}, text};
}

inline Sample knet_sample()
{
  double mean = 0, peak = 0;
  std::vector<long> counts;
  for (int i = 0; i < sample_count; ++i)
  {
    counts.push_back(std::lround(sample_value(i) * 8388608 / 2000) - 12085);
    mean += double(counts.back()) / sample_count;
  }
  for (long count : counts) peak = std::max(peak, std::abs(double(count) - mean) * 2000 / 8388608);
  std::string text =
      "Origin Time       2001/01/01 19:51:00\nLat.              41.0\nLong.             142.5\n"
      "Depth. (km)       30\nMag.              6.2\nStation Code      MADE01\n"
      "Station Lat.      41.5267\nStation Long.     140.9244\nStation Height(m) 39\n"
      "Record Time       2001/01/01 19:51:43\nSampling Freq(Hz) 100Hz\nDuration Time(s)  4\n"
      "Dir.              E-W\nScale Factor      2000(gal)/8388608\n" +
      print("Max. Acc. (gal)   %.3f\n", peak) + "Last Correction   2001/01/01 19:51:43\nMemo.             \n";
  for (int i = 0; i < sample_count; ++i)
    text += print("%8ld ", counts[std::size_t(i)]) + (i % 8 == 7 ? "\n" : "");
  return {"knet", {.file = "MADE010101011951.EW"}, text};
}

inline Sample esm_sample()
{
  return {
      "esm",
      {.file = "made.HNE.ASC"},
      "EVENT_NAME: MADE\nEVENT_ID: M-2001-0001\nEVENT_DATE_YYYYMMDD: 20010101\nMAGNITUDE_W: 5.2\n"
      "NETWORK: XX\nSTATION_CODE: MADE\nVS30_M/S: \nSAMPLING_INTERVAL_S: 0.010000\nNDATA: 400\n"
      "DURATION_S: 3.99\nSTREAM: HNE\nUNITS: cm/s^2\nINSTRUMENT: \n" +
          print("PGA_CM/S^2: %.6f\n", sample_peak()) +
          "TIME_PGA_S: 1.7\nHEADER_FORMAT: DYNA 1.2\nDATA_TYPE: ACCELERATION\nPROCESSING: none\nUSER1: \n" +
          body("%.6f", 1)};
}

inline Sample smc_sample()
{
  std::string text = "2 CORRECTED ACCELEROGRAM\n*\nMADE\n     2001  01  01    0004 Made\n"
                     "Moment Mag=      7.1\nstation = Made, 1 Street          component=    360\n"
                     "epicentral dist =     89.0\ninst type=SMA-1      data source = none\n*\n*\n*\n";
  double high = 0, low = 0;
  for (int i = 0; i < sample_count; ++i)
  {
    high = std::max(high, sample_value(i));
    low = std::min(low, sample_value(i));
  }
  text += header_numbers(48, 8, "%10.0f", -32768, {{16, 2}, {17, sample_count}});
  text += header_numbers(50, 5, "%15.7E", 1.7e38, {{2, 100}, {30, high}, {32, low}});
  text += "| made\n| of no earthquake\n";
  for (int i = 0; i < sample_count; ++i) // 1P8E10.4E1
  {
    const double value = sample_value(i);
    const int power = value == 0 ? 0 : int(std::floor(std::log10(std::abs(value)) + 1e-9));
    text += print("%7.4fE%+d", value * std::pow(10, -power), power) + (i % 8 == 7 ? "\n" : "");
  }
  return {"smc", {.file = "made.smc"}, text};
}

inline std::string cosmos_channel(int component)
{
  const std::string number = std::to_string(component + 1);
  return "Corrected acceleration    (Format v01.20 with 13 text lines) Src: made\nMade        January "
         "1,2001\n"
         "Hypocenter: 34.0580  -117.0110  H= 12km\nOrigin: 01/01/2001, 20:53:26.1 UTC\nStatn No: 01-1  "
         "Code:CE-1\n"
         "Coords: 34.0460 -117.0350\nRecorder: made\nRcrd start time:01/01/2001, 20:53:04.400 UTC\nSta Chan  "
         " " +
         number + ": " + (component == 0 ? "340" : "070") +
         " deg (Rcrdr Chan  1) Location: made\nRaw record length =  4.000  sec\nProcessed: 01/01/2001\n"
         "Record filtered below 0.30  Hz\nValues used when parameter or data value is unknown:   -999, "
         "-999.0\n"
         " 100 Integer-header values follow on  10 lines, Format= (10I8)\n" +
         header_numbers(100, 10, "%8.0f", -999, {{1, 2}, {2, 1}}) +
         " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n" +
         header_numbers(100, 6, "%13.6f", -999, {{62, 10}, {63, 4}, {64, sample_peak(component)}}) +
         "  1 Comment line(s) follow, each starting with a \"|\":\n | made\n"
         "    400  acceleration pts, approx    4 secs, units=cm/sec2(04),Format=(8F10.5)\n" +
         body("%10.5f", 8, 1, component) + "/&  ----------  End of data for channel  " + number +
         "  ----------\n";
}

inline Sample cosmos_sample()
{
  return {"cosmos", {.file = "made.V2c", .component = "340 deg"}, cosmos_channel(0) + cosmos_channel(1)};
}

inline std::string csmip_channel(int component, const std::string& name)
{
  std::string head =
      "Corrected accelerogram   58667-L2866-14236.52       Chan  1:  made\nUncorrected Accelerogram Data\n"
      "Rcrd of Mon Jan 01, 2001               (Avol1 v0.8, 5/14 CSMIP)\nCSMIP Preliminary Processing\n"
      "58667-L2866-14236.52\nStation No. 58667   37.973N, 122.038W\nMade\nChan  " +
      std::to_string(component + 1) + ":  " + name + "\nRcrd of Mon Jan 01, 2001\n";
  head += print("Peak acceleration =    %.3f    cm/sec/sec  at    1.700   sec.\n", sample_peak(component));
  head += header_numbers(100, 16, "%5.0f", 0, {}) + header_numbers(100, 8, "%10.3f", 0, {});
  return head + "   400 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)\n" +
         body("%10.5f", 8, 1, component) +
         "   400 points of veloc data equally spaced at  .010 sec, in cm/sec.  (8f10.6)\n" +
         body("%10.5f", 8, 0.1, component) + "/&  ----------  End of data for channel  1  ----------\n";
}

inline Sample csmip_sample()
{
  return {
      "csmip", {.file = "CE00001.V2", .component = "H1"}, csmip_channel(0, "H1") + csmip_channel(1, "Up")};
}

inline Sample csmip_raw_sample()
{
  return {"csmip",
          {.file = "CE00001.V1"},
          "Uncorrected Accelerogram Data             Processed: 02/13/12, CGS\n"
          "Record of Mon Jan 01, 2001             (Avol1 v9.2,12/11 CSMIP)\nChan  1: 360 Deg\n"
          "No. of Points =  400  Record Length =  4.000 sec   at 100 Samples/sec\n" +
              print("Units of uncor data are sec and g .        Max  =   %.4f g , at   1.700 sec.\n",
                    std::abs(sample_peak()) / 980.665) +
              header_numbers(100, 16, "%5.0f", 0, {}) +
              "   400 Accelerogram points at 100 pts/sec in units of g .      Format: (8f9.6)\n" +
              body("%9.6f", 8, 1 / 980.665) + "/&  ----------  End of data for channel  1  ----------\n"};
}

inline Sample cwb_sample()
{
  std::string text =
      "#Earthquake Information\n#Origin Time(GMT+08): 2001/01/01-23:50:42\n\n#StationCode: MADE\n"
      "#RecordLength(sec): 4\n#SampleRate(Hz): 100\n#AmplitudeUnit:  gal. DCoffset(corr)\n";
  const std::string names = "UNE";
  for (int c = 0; c < 3; ++c)
  {
    double high = 0, low = 0;
    for (int i = 0; i < sample_count; ++i)
    {
      high = std::max(high, sample_value(i, c));
      low = std::min(low, sample_value(i, c));
    }
    text += print("#AmplitudeMAX. %c: %8.3f~ %8.3f\n", names[std::size_t(c)], high, low);
  }
  text += "#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3 \n";
  for (int i = 0; i < sample_count; ++i)
    text += print("%10.3f%10.3f%10.3f%10.3f\n", sample_dt * i, sample_value(i), sample_value(i, 1),
                  sample_value(i, 2));
  return {"cwb", {.file = "made.dat", .component = "U"}, text};
}

inline std::string geonet_component(int component, const std::string& name)
{
  return "Corrected accelerogram 20010101_211554_MADE_20 GNS Science\nSite MADE      39 56 38S  176 35 "
         "04E\nMade\n"
         "Instrument Made_1\nResolution: 24-bit\nAccelerogram 20010101_211554_MADE_20\n6 km south of Made\n"
         "2001 January 1         21:15:54 UT\nEpicentre  40 03 27S 176 32 45E\n"
         "Number of points   400    Duration   3.99 sec\nInstrument corrected data at 0.010 sec intervals\n"
         "Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz\nComponent " +
         name + "  Made Accelerometer Axis\n" +
         print("Acceleration:  peak %8.1f mm/s/s at   1.70 sec     rms      2.2 mm/s/s\n",
               10 * sample_peak(component)) +
         "Velocity:      peak     1.65 mm/s   at  43.56 sec     rms     0.09 mm/s\n"
         "Displacement:  peak    0.131 mm     at  43.66 sec     rms    0.007 mm\n" +
         header_numbers(40, 10, "%8.0f", 0, {}) + header_numbers(60, 10, "%8.2f", 0, {}) +
         body("%8.1f", 10, 10, component) + body("%8.2f", 10, 1, component) +
         body("%8.3f", 10, 0.1, component);
}

inline Sample geonet_sample()
{
  return {"geonet",
          {.file = "made.V2A", .component = "S16W"},
          geonet_component(0, "S16W") + geonet_component(1, "S74E") + geonet_component(2, "Up")};
}

inline std::string bhrc_component(int component, const std::string& name)
{
  return "* VOL1DS FILE:  5522/01\nInst Type = SSA-2\nOrigin Time : 2001/01/01   12:23:16\n\n" +
         name.substr(0, 1) + "\n          \nCOMP " + name +
         "\nMade                 Station   37.485 N 45.891 E   Azimuth L 324   T 54 \n" +
         "Epicenter 38.520 N 46.860 E\nINSTR PERIOD =  .019 SEC   DAMPING =  .640\n"
         "NO. OF POINTS =    400      DURATION =   4.000                        \nUNITS ARE SECONDS AND "
         "G/10\n       \n" +
         header_numbers(100, 15, "%5.0f", 0, {}) +
         header_numbers(35, 5, "%13.6E", 0, {{1, .0193}, {6, 100}}) +
         body("%13.6E", 10, 10 / 980.665, component) + "* END OF RECORD\n";
}

inline Sample bhrc_sample()
{
  return {"bhrc",
          {.file = "made.V1", .component = "L1"},
          bhrc_component(0, "L1") + bhrc_component(1, "V1") + bhrc_component(2, "T1")};
}

inline std::vector<Sample> samples()
{
  return {peer_sample(), at2_sample(),    column_sample(), table_sample(), knet_sample(),
          esm_sample(),  smc_sample(),    cosmos_sample(), csmip_sample(), csmip_raw_sample(),
          cwb_sample(),  geonet_sample(), bhrc_sample()};
}
} // namespace mpm::test
