#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/base/constants.h"
#include "sim/recording/log_motions.h"
#include "sim/recording/log_study.h"
#include "sim/recording/log_time.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::sim {
namespace {

using Catch::Contains;
using pipeline::message_of;
using pipeline::Scratch;

constexpr double bound = 0.1 * degree;

pipeline::Robot two_axes() {
  pipeline::Robot robot;
  robot.name = "two axes";
  robot.links.resize(3);
  for (int k = 0; k < 2; ++k) {
    pipeline::Joint& joint = robot.joints.emplace_back();
    joint.name = "joint_" + std::to_string(k + 1);
    joint.lower = -3, joint.upper = 3, joint.speed = 2, joint.acceleration = 10;
  }
  return robot;
}

Recording read(const std::string& text, LogOptions options = {.still = bound}) {
  const Scratch scratch;
  return read_log(scratch.write("log.csv", text), two_axes(), options);
}

/// Writes a log in degrees: rows at a rate from time 0 on.
class Writer {
 public:
  explicit Writer(double rate, double noise = 0) : rate_(rate), noise_(noise) {}
  /// Appends a part. angles: function of the time since the start of this part [deg].
  template <class Angles>
  void part(double seconds, const Angles& angles) {
    std::uniform_real_distribution<double> any(-noise_, noise_);
    for (; rows_ / rate_ < begin_ + seconds; ++rows_) {
      const auto [a, b] = angles(rows_ / rate_ - begin_);
      text_ += fmt::format("{:.6f},{:.6f},{:.6f}\n", rows_ / rate_, a + any(random_), b + any(random_));
    }
    begin_ += seconds;
  }
  void stand(double seconds) {
    part(seconds, [](double) { return std::pair(0.0, 0.0); });
  }
  Recording recording() const { return read("time,j1_deg,j2_deg\n" + text_); }

 private:
  double rate_, noise_, begin_ = 0;
  int rows_ = 0;
  std::string text_;
  std::mt19937 random_{7};
};

/// Returns a motion from 0 to 0 in `seconds`, at rest at both ends, with a round trip of axis 2 in the first half [deg].
auto cycle(double seconds, double size = 1) {
  return [seconds, size](double t) {
    const double u = t / seconds, wave = (1 - std::cos(2 * std::numbers::pi * u)) / 2;
    const double early = u < 0.5 ? (1 - std::cos(4 * std::numbers::pi * u)) / 2 : 0;
    return std::pair(60 * size * wave, 30 * size * early);
  };
}

}  // namespace

TEST_CASE("log: time stamps of loggers and spreadsheets") {
  const auto seconds_between = [](const std::string& a, const std::string& b) {
    LogTime clock({});
    const auto first = clock.read(a), second = clock.read(b);
    return first && second ? *second - *first : NAN;
  };
  constexpr double rounding = 1e-6;  // seconds since 1970 in a double
  CHECK(seconds_between("2027-02-28T23:59:59.5", "2027-03-01T00:00:01") == Approx(1.5).margin(rounding));
  CHECK(seconds_between("28.02.2027 23:59:59,5", "01.03.2027 00:00:01") == Approx(1.5).margin(rounding));
  CHECK(seconds_between("02/28/2027 11:59:59 PM", "03/01/2027 12:00:01 AM") == Approx(2).margin(rounding));
  CHECK(seconds_between("2027-03-01 08:00:00+01:00", "2027-03-01T07:00:00Z") == Approx(0).margin(rounding));
  CHECK(seconds_between("23:59:59.9", "00:00:00.1") == Approx(0.2).margin(rounding));
  CHECK(seconds_between("1804500000000", "1804500000250") == Approx(0.25).margin(rounding));
  const auto words = [](double seconds) {
    LogTime clock(seconds);
    clock.read("7");
    return clock.words();
  };
  CHECK(words(1) == "numbers in s");
  CHECK(words(1e-3) == "numbers in ms");
  const auto second_row = [](const std::string& title) {
    return read(title + ",J1_deg,J2_deg\n0,100,0\n1e-4,101,0\n").times[1] / 1e-4;
  };
  for (const char* const minutes : {"time_min", "t [min]", "Time (minutes)"}) CHECK(second_row(minutes) == Approx(60));
  for (const char* const hours : {"time_h", "time [hours]"}) CHECK(second_row(hours) == Approx(3600));
  CHECK(second_row("time (milliseconds)") == Approx(1e-3));
  for (const char* const micro : {"time_us", "time [\xC2\xB5s]", "time [\xCE\xBCs]", "time [\xB5s]"})
    CHECK(second_row(micro) == Approx(1e-6));
  for (const char* wrong : {"", "soon", "2027-02-30 10:00:00", "2027-03-01", "10:61:00", "25:10:00", "10:20:61", "nan"})
    CHECK_FALSE(LogTime({}).read(wrong));
}

TEST_CASE("log: semicolons, decimal commas, dates over midnight, a repeated stamp, a missing number, names again") {
  const std::string names = "Datum;Zeit;Achse_1 [deg];Achse_2 [deg];Kraft\n";
  const Recording log = read("\xEF\xBB\xBF" + names +
                             "01.03.2027;23:59:59,8;0,0;0;7\n"
                             "01.03.2027;23:59:59,9;2,5;0;7\n"
                             "02.03.2027;00:00:00,0;5,0;-1,5;7\n"
                             "02.03.2027;00:00:00,0;5,0;-1,5;7\n" +
                             names +
                             "02.03.2027;00:00:00,0;6,0;-2;7\n"
                             "02.03.2027;00:00:00,1;7,5;;7\n"
                             "02.03.2027;00:00:00,2;9,5;-3;7\n");
  REQUIRE(log.size() == 5);
  const double times[] = {0, 0.1, 0.2, 0.3, 0.4}, first[] = {0, 2.5, 5, 6, 9.5}, second[] = {0, 0, -1.5, -2, -3};
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(log.times[k] == Approx(times[k]).margin(1e-6));  // seconds since 1970 in a double
    CHECK(log.at(k)[0] == Approx(first[k] * degree).margin(1e-12));
    CHECK(log.at(k)[1] == Approx(second[k] * degree).margin(1e-12));
  }
  CHECK(log.lines == std::vector<std::uint32_t>{2, 3, 4, 7, 9});
  CHECK(log.rows == 6);
  CHECK(log.same_stamp == 2);
  CHECK(log.left_out == 1);
  CHECK(log.first_left_out == 8);
  for (const char* const stamp : {"Datum Zeit", "Date/Time", "Zeitstempel", "Time stamp", "Datum/Uhrzeit"})
    CHECK(read(std::string(stamp) +
               ";Achse_1 [deg];Achse_2 [deg]\n01.03.2027 23:59:59,8;0,0;0\n02.03.2027 00:00:00,0;2,5;0\n")
              .times[1] == Approx(0.2).margin(1e-6));
}

TEST_CASE("log: a logger that was off, a wrong time and times in milliseconds are named") {
  std::string text = "time,J1_deg,J2_deg\n";
  for (int k = 0; k < 40; ++k)  // line k + 2; a gap of 500 s before line 22, a wrong time in line 32
    text += std::to_string(k == 30 ? 100 : 0.1 * k + (k < 20 ? 0 : 500)) + "," + std::to_string(100 + k) + ",0\n";
  const Recording log = read(text);
  CHECK(log.back == 1);
  CHECK(log.first_back == 32);
  CHECK(log.pauses == 2);
  CHECK(log.longest_pause == Approx(500).margin(1));
  CHECK(log.line_of_pause == 22);
  CHECK(log.pause_seconds == Approx(500 + 403).margin(1));
  CHECK_THAT(message_of([] { read("time,J1_deg,J2_deg\n0,100,0\n100,101,0\n200,102,0\n"); }), Contains("milliseconds"));
}

TEST_CASE("log: columns of the measured angles among others, and what names no angles") {
  const std::string both = "timestamp,target_q_0,target_q_1,actual_q_0,actual_q_1,actual_qd_0,actual_qd_1\n";
  const Recording log = read(both + "0,9,9,0.5,-0.5,9,9\n0.1,9,9,0.6,-0.6,9,9\n");
  CHECK(log.at(0)[0] == 0.5);  // RTDE uses rad
  CHECK(log.at(1)[1] == -0.6);
  const Recording swapped = read("time,elbow,base\n0,100,-50\n1,101,-49\n", {.joints = "base,elbow", .still = bound});
  CHECK(swapped.at(0)[0] == Approx(-50 * degree));
  CHECK(read("J1,J2\n100,1\n101,1\n", {.rate = 4, .still = bound}).times[1] == 0.25);
  CHECK_THAT(message_of([] { read("time,left1,left2,right1,right2\n0,1,2,3,4\n"); }),
             Contains("several groups of 2 columns"));
  CHECK_THAT(message_of([] { read("time,x,y,z\n0,1,2,3\n"); }), Contains("no 2 columns that are the angles"));
  CHECK_THAT(message_of([] { read("J1,J2\n100,1\n"); }), Contains("no column of times") && Contains("rate_Hz"));
  CHECK_THAT(message_of([] { read("time,J1,J2\n0,1,2\n1,1.5,2\n"); }),
             Contains("without a unit") && Contains("unit=deg"));
  CHECK_THAT(message_of([] { read("0,1,2\n1,1,2\n"); }), Contains("begins with numbers"));
  CHECK_THAT(message_of([] { read("time,J1_deg,J2_deg\n0,500,2\n"); }),
             Contains("log.csv:2:1") && Contains("turns joint_1 to 500"));
  CHECK_THAT(message_of([] { read("time,J1_deg,J2_deg\n0,1,5,2\n"); }),
             Contains("decimal commas need another separator"));
  CHECK_THAT(message_of([] { read("#ROSBAG V2.0\n"); }), Contains("is a ROS bag") && Contains("rostopic echo"));
  CHECK_THAT(message_of([] { read("PK\x03\x04"); }), Contains("workbook"));
}

TEST_CASE("log: one row that no axis can reach is left out, also outside the limits and while the robot stands") {
  for (const double rate : {10., 125.})
    for (const double off : {30., 300.})
      for (const double seconds : {0.5, 2.0, 4.9}) {  // at rest, moving, at rest
        const auto angle = [](double t) {
          return t < 1 || t > 4 ? 0 : 30 * (1 - std::cos(2 * std::numbers::pi * (t - 1) / 3));
        };
        const int wrong = static_cast<int>(std::lround(seconds * rate));
        std::string text = "time,j1_deg,j2_deg\n", clean = text;
        for (int k = 0; k < 6 * rate; ++k) {
          const double t = k / rate;
          text += fmt::format("{:.4f},{:.5f},0\n", t, angle(t) + (k == wrong ? off : 0));
          if (k != wrong) clean += fmt::format("{:.4f},{:.5f},0\n", t, angle(t));
        }
        const Recording log = read(text), expected = read(clean);
        CAPTURE(rate, off, seconds);
        CHECK(log.impossible.glitches == std::vector<std::uint32_t>{static_cast<std::uint32_t>(wrong + 2)});
        CHECK(log.impossible.jumps.empty());
        CHECK(expected.impossible.glitches.empty());
        CHECK(log.angles == expected.angles);
        CHECK(log.columns[0].high == Approx(60 * degree).margin(0.5 * degree));  // the rows may miss the peak
      }
}

TEST_CASE("log: a jump stays and is named, and stops, noise and coarse clocks are no faults") {
  std::string text = "time,j1_deg,j2_deg\n";
  for (int k = 0; k < 40; ++k) text += fmt::format("{:.1f},{},0\n", 0.1 * k, k < 20 ? 0 : 60);
  const Recording log = read(text);
  CHECK(log.impossible.glitches.empty());
  REQUIRE(!log.impossible.jumps.empty());
  CHECK(log.impossible.jumps[0] == 22);
  const Course course(log, two_axes(), bound);
  const Cycles none;
  const auto words = fmt::format("{}", fmt::join(log_words(log, course, none, {}), "\n"));
  CHECK_THAT(words, Contains("stays in the motion: line 22"));
  // From 110 deg/s to rest within one row, with times rounded to the interval, and encoder noise.
  for (const double rate : {10., 125.}) {
    text = "time,j1_deg,j2_deg\n";
    for (int k = 0; k < rate; ++k)
      text += fmt::format("{:.3f},{:.3f},0\n", k / rate + (k % 3 == 0 ? 0.4 / rate : 0),
                          std::min(110 * k / rate, 55.) + 0.05 * (k % 2));
    const Recording stop = read(text);
    CAPTURE(rate);
    CHECK(stop.impossible.glitches.empty());
    CHECK(stop.impossible.jumps.empty());
  }
}

TEST_CASE("log: an angle that wraps at a turn is refused with its line and axis, at any rate and after a standstill") {
  pipeline::Robot robot = two_axes();
  robot.joints[1].lower = -7, robot.joints[1].upper = 7;
  const auto fault = [&](double interval, double stand, double from, const auto& written) {
    std::string text = "time,J1_deg,J2_deg\n";
    for (int k = 0; k < 40; ++k)
      text += fmt::format("{},20,{:.3f}\n", interval * k + (k > 20 ? stand : 0),
                          written(from + 100 * (1 - std::cos(0.3 * interval * std::max(k - 20, 0)))));
    const Scratch scratch;
    return message_of([&] { read_log(scratch.write("log.csv", text), robot, {.still = bound}); });
  };
  const auto wrapped = [](double angle) { return std::remainder(angle, 360); };
  for (const double interval : {0.008, 0.1, 1.0})
    for (const double stand : {0., 7.}) {
      CAPTURE(interval, stand);
      CHECK_THAT(
          fault(interval, stand, interval < 0.1 ? 179.999 : 179, wrapped),
          Contains("error: joint_2 (J2_deg) turns by 3") && Contains("its angle wraps at a turn; unwrap the column"));
    }
  CHECK_THAT(fault(0.1, 0, 179.95, wrapped), Contains("log.csv:24:1"));
  CHECK_THAT(fault(0.1, 0, -1, [](double angle) { return angle < 0 ? angle + 360 : angle; }),
             Contains("from 359.7 to 0."));
  CHECK(fault(0.1, 0, 179, [](double angle) { return angle; }).empty());
  robot.joints[1].upper = 3;
  CHECK_THAT(fault(0.1, 0, -1, [](double angle) { return angle < 0 ? angle + 360 : angle; }),
             Contains("turns joint_2 to 359") && Contains("; in line 27 joint_2 (J2_deg) turns by 3") &&
                 Contains("unwrap the column") && Contains("check the unit"));
}

TEST_CASE("log: columns, times, unit and ranges are stated, and columns that fit other axes") {
  pipeline::Robot robot = two_axes();
  robot.joints[0].lower = -0.5, robot.joints[1].speed = 0.5;
  const auto exchanged = [&](double size) {  // J1 turns to -60 deg, J2 moves fast
    std::string text = "Zeit;J1 [deg];J2 [deg]\n";
    for (int k = 0; k < 60; ++k) {
      const double wave = 1 - std::cos(2 * std::numbers::pi * k / 60);
      std::string row = fmt::format("{:.1f};{:.3f};{:.3f}", 0.1 * k, -size * wave, 20 * wave * wave);
      std::replace(row.begin(), row.end(), '.', ',');
      text += row + "\n";
    }
    return text;
  };
  const auto read_from = [&](const std::string& text, const LogOptions& options) {
    const Scratch scratch;
    return read_log(scratch.write("log.csv", text), robot, options);
  };
  const LogOptions plain{.still = bound};
  CHECK_THAT(message_of([&] { read_from(exchanged(30), plain); }),
             Contains("the columns of joint_1, joint_2 may be exchanged"));
  CHECK_THAT(message_of([&] { read_from(exchanged(30), plain); }), Contains("--value \"joints=J2 [deg],J1 [deg]\""));
  const Recording slow = read_from(exchanged(10), plain);  // within the limits, but joint_2 turns too fast
  const Course course(slow, robot, bound);
  const auto words = fmt::format("{}", fmt::join(read_words(slow, course), "\n"));
  CHECK_THAT(
      words,
      Contains(
          "separator ';', decimal commas; times in Zeit: numbers in s; angles in degrees by the names of the columns"));
  CHECK_THAT(words, Contains("joint_1  J1 [deg]       -20.0 .. 0.0"));
  CHECK_THAT(words, Contains("warning: the columns of joint_1, joint_2 may be exchanged"));
  CHECK(slow.external.empty());
  CHECK_THAT(words, !Contains("left out"));
  std::string more = exchanged(10);  // a rail, a third axis, and a column that is no axis
  for (std::size_t at = 0, row = 0; (at = more.find('\n', at)) != more.npos; ++row) {
    const std::string cells = row == 0 ? ";E1 [mm];J3 [deg];Temp 1" : ";5;6;20";
    more.insert(at, cells), at += cells.size() + 1;
  }
  const Recording wide = read_from(more, plain);
  CHECK(wide.external == std::vector<std::string>{"E1 [mm]", "J3 [deg]"});
  CHECK_THAT(fmt::format("{}", fmt::join(read_words(wide, Course(wide, robot, bound)), "\n")),
             Contains("warning: left out, because the robot of the job has no such axes: E1 [mm], J3 [deg]. "));
  const Recording right = read_from(exchanged(10), {.joints = "J2 [deg],J1 [deg]", .still = bound});
  CHECK_THAT(fmt::format("{}", fmt::join(read_words(right, Course(right, robot, bound)), "\n")),
             !Contains("exchanged"));
}

TEST_CASE("log: radians under names in degrees, and times in another unit, have a remedy that works") {
  const auto text_of = [](double size, double step, const char* time, double least = 0, double phase = 0.1) {
    std::string text = fmt::format("{},J1_deg,J2_deg\n", time);
    for (int k = 0; k < 200; ++k)
      text += fmt::format("{:.6f},{:.5f},{:.5f}\n", step * k, least + size * (1 - std::cos(phase * k)),
                          size * std::sin(phase * k));
    return text;
  };
  const auto words = [](const std::string& text, LogOptions options = {.still = bound}) {
    const Recording log = read(text, options);
    return fmt::format("{}", fmt::join(read_words(log, Course(log, two_axes(), bound)), "\n"));
  };
  CHECK_THAT(words(text_of(30, 0.1, "time_s")), !Contains("warning"));
  const std::string radians = text_of(0.8, 0.1, "time_s");
  CHECK_THAT(words(radians), Contains("no angle of the log is larger than 1.6 deg (limit 6.28 or more)") &&
                                 Contains("--value unit=rad"));
  CHECK_THAT(words(radians, {.unit = "rad", .still = bound}), !Contains("warning"));
  CHECK_THAT(words(text_of(0.04, 0.1, "time_s", 3)), !Contains("radians"));  // a robot at rest at 3 deg, with noise
  const std::string short_times = text_of(30, 0.1, "time_ms");               // seconds in a column named ms
  CHECK_THAT(words(short_times), Contains("an axis turns") &&
                                     Contains("--value rate_Hz=10 if they are 1000 times as long: a row in 0.1 s"));
  CHECK_THAT(words(short_times, {.rate = 10, .still = bound}), !Contains("warning"));
  const std::string long_times = text_of(6, 2, "time", 0, 0.03);  // 90 deg/s at 500 Hz, milliseconds read as seconds
  CHECK_THAT(words(long_times), Contains("no axis turns faster than 0.1 % of its limit") &&
                                    Contains("--value rate_Hz=500 if they are 0.001 times as long: a row in 0.002 s"));
  CHECK_THAT(words(long_times, {.rate = 500, .still = bound}), !Contains("0.001 times"));
}

TEST_CASE("log: rows that are too far apart for the moves are named, with any rests, noise and stamps, and no others") {
  const auto words = [](double interval, double rest, double noise, bool only_changes, double seconds = 1) {
    std::mt19937 random{5};
    std::uniform_real_distribution<double> any(-1, 1);
    std::string text = "time,j1_deg,j2_deg\n";
    double from[2] = {}, to[2] = {}, begin = 0, written[2] = {99, 99};
    const double length = seconds + rest;
    for (double t = 0; t < 100 * length; t += interval) {
      for (; t >= begin + length; begin += length)
        for (int k = 0; k < 2; ++k) from[k] = to[k], to[k] = 30 * any(random);
      const double u = std::min(1., (t - begin) / seconds), s = u * u * u * (10 - 15 * u + 6 * u * u);
      double angles[2];
      for (int k = 0; k < 2; ++k) angles[k] = from[k] + s * (to[k] - from[k]);
      if (only_changes && std::abs(angles[0] - written[0]) + std::abs(angles[1] - written[1]) < 0.1) continue;
      text += fmt::format("{:.3f}", t + 0.2 * interval * any(random));
      for (int k = 0; k < 2; ++k) text += fmt::format(",{:.3f}", (written[k] = angles[k]) + noise * any(random));
      text += '\n';
    }
    const Recording log = read(text);
    return fmt::format("{}", fmt::join(read_words(log, Course(log, two_axes(), bound)), "\n"));
  };
  for (const double rest : {0., 1.3})
    for (const double noise : {0., 0.04, 0.3})
      for (const bool only_changes : {false, true}) {
        CAPTURE(rest, noise, only_changes);
        for (const double interval : {1., 1.9})
          CHECK_THAT(words(interval, rest, noise, only_changes), Contains("last less than 2 such intervals"));
        for (const double interval : {0.05, 0.1, 0.3})
          CHECK_THAT(words(interval, rest, noise, only_changes), !Contains("warning: rows are"));
        CHECK_THAT(words(1.9, rest, noise, only_changes, 20), !Contains("warning: rows are"));  // slow moves
      }
  for (const double rest : {0.7, 4.}) CHECK_THAT(words(0.3, rest, 0.04, false), !Contains("warning: rows are"));
  CHECK_THAT(words(1, 4, 0.04, false), Contains("warning: rows are 1 s apart, and ") &&
                                           Contains("Log 10 rows per second or more, or import the robot's program"));
}

TEST_CASE("log: its length is known before it is read") {
  const Scratch scratch;
  std::string text = "time,j1_deg,j2_deg\n";
  for (int k = 0; k < 20'000; ++k) text += fmt::format("{:09.2f},{:08.3f},{:08.3f}\n", 0.1 * k, 1., 2.);
  const LogSize size = size_of_log(scratch.write("log.csv", text), two_axes(), {.still = bound});
  CHECK(size.rows == Approx(20'000).epsilon(0.01));  // the line of names counts as a row
  CHECK(size.seconds == Approx(2'000).epsilon(0.01));
}

TEST_CASE("log: a spline through exact samples gives back the curve") {
  Writer writer(10);
  writer.part(4, [](double t) { return std::pair(57 * (1 - std::cos(std::numbers::pi * t / 2)) / 2, 0.0); });
  writer.stand(1);
  const Course course(writer.recording(), two_axes(), bound);
  // 5/384 h^4 of the largest fourth derivative, (pi/2)^4 57/2 deg/s^4, plus the six digits of the log.
  const double error = (5. / 384 * 1e-4 * std::pow(std::numbers::pi / 2, 4) * 28.5 + 2e-6) * degree;
  for (double t = 0; t < 4; t += 0.013)
    CHECK(course.at(t)[0] == Approx(57 * degree * (1 - std::cos(std::numbers::pi * t / 2)) / 2).margin(error));
  CHECK(course.log_seconds == Approx(4.9).margin(1e-9));
  CHECK(course.stand_seconds == Approx(0.9).margin(0.11));  // error of one interval at the last moving row
  CHECK(course.too_fast.empty());
}

TEST_CASE("log: noise of half the bound neither moves the robot nor leaves the bound") {
  const double noise = 0.05;                     // [deg]
  const double rate = GENERATE(100 / 3., 125.);  // [Hz]: two to four rows around each knot, or twelve
  Writer quiet(rate), noisy(rate, noise);
  for (Writer* writer : {&quiet, &noisy}) {
    writer->stand(2);
    writer->part(4, cycle(4));
    writer->stand(5);
  }
  const Recording exact = quiet.recording(), log = noisy.recording();
  const Course course(log, two_axes(), bound), truth(exact, two_axes(), bound);
  CHECK(course.largest_smoothing <= bound);
  CHECK(course.largest_smoothing > 0);
  // With two rows on either side a knot lies between rows, otherwise on a row.
  CHECK(std::ranges::any_of(course.knots(),
                            [&](double t) { return std::abs(std::remainder(t, 1 / rate)) > 0.3 / rate; }));
  for (std::size_t k = 0; k < log.size(); ++k)
    CHECK((course.at(log.times[k]) - Eigen::Map<const Eigen::Vector2d>(log.at(k))).lpNorm<Eigen::Infinity>() <=
          1.0001 * bound);
  // Knots 0.05 s apart that alternate by all of the noise: 12 n/h^2. With rows as knots: 9,400 deg/s2.
  const double limit = 12 * noise * degree / (0.05 * 0.05), h = 0.01;
  double largest = 0;
  for (double t = 2.2; t < 5.8; t += 0.01)
    largest = std::max(largest, ((course.at(t - h) - 2 * course.at(t) + course.at(t + h)) -
                                 (truth.at(t - h) - 2 * truth.at(t) + truth.at(t + h)))
                                        .lpNorm<Eigen::Infinity>() /
                                    (h * h));
  CHECK(largest < limit);
  CHECK(course.at(1) == course.at(0.2));                                   // at rest
  CHECK(course.stand_seconds == Approx(truth.stand_seconds).margin(0.4));  // slow starts are within the bound
}

TEST_CASE("log: rows that are missing in a fine log leave a smooth course") {
  std::string text = "time,j1_deg,j2_deg\n";
  const auto angle = [](double t) { return 30 * (1 - std::cos(std::numbers::pi * t / 2)); };
  for (int k = 0; k <= 500; ++k)
    if (k < 100 || k > 130) text += fmt::format("{:.3f},{:.6f},0\n", 0.008 * k, angle(0.008 * k));
  const Course course(read(text), two_axes(), bound);
  CHECK(course.gaps == 0);
  for (double t = 0; t < 4; t += 0.01)
    CHECK(course.at(t)[0] / degree == Approx(angle(t)).margin(0.2));  // 0.25 s without a row
}

TEST_CASE("log: times that jitter by nearly half an interval leave knots in order and finite angles") {
  std::string text = "time,j1_deg,j2_deg\n";
  std::mt19937 random{3};
  std::uniform_real_distribution<double> jitter(-0.008, 0.008);
  for (int k = 0; k <= 1000; ++k)
    text += fmt::format("{:.4f},{:.4f},0\n", 1 + 0.02 * k + jitter(random),
                        30 * (1 - std::cos(std::numbers::pi * 0.02 * k)));
  const Course course(read(text), two_axes(), bound);
  for (std::size_t k = 1; k < course.knots().size(); ++k) CHECK(course.knots()[k] > course.knots()[k - 1]);
  for (double t = 0; t < course.duration(); t += 0.01) CHECK(std::isfinite(course.at(t)[0]));
}

TEST_CASE("log: a gap with a move is no time, and a speed beyond the limit is named") {
  std::string text = "time,j1_deg,j2_deg\n";
  for (int k = 0; k <= 20; ++k) text += fmt::format("{:.1f},{},0\n", 0.1 * k, 2. * k);
  for (int k = 0; k <= 20; ++k)
    text += fmt::format("{:.1f},{},0\n", 600 + 0.1 * k, -40 + (k < 10 ? 0. : 25. * (k - 10) / 2));
  const Course course(read(text), two_axes(), bound);
  CHECK(course.gaps == 1);
  CHECK(course.gap_seconds == Approx(598));
  CHECK(course.log_seconds == Approx(4));
  CHECK(course.duration() < 4 + 3 * (80 * degree / 2) + 1);  // a move at no less than half the speed
  REQUIRE(course.too_fast.size() == 1);                      // 125 deg/s with 115 allowed
  CHECK(course.too_fast[0].axis == "joint_1");
  CHECK(course.too_fast[0].speed > 125 * degree);
  CHECK(course.too_fast[0].line > 32);
}

TEST_CASE("log: cycles are counted with other times and waits, and the rest is one motion") {
  Writer writer(25, 0.02);
  const double times[] = {8, 8.3, 7.8, 8.1, 7.7, 8, 8.2, 8.4, 7.9, 8.1, 8};
  int count = 0;
  for (const double seconds : times) {
    writer.stand(1 + 0.7 * (count % 4));
    writer.part(seconds, cycle(seconds));
    if (++count == 7) {
      writer.stand(1);
      writer.part(9, [](double t) {
        return std::pair(-20 * (1 - std::cos(2 * std::numbers::pi * t / 9)),
                         8 * std::sin(2 * std::numbers::pi * t / 9));
      });
      writer.stand(100);
    }
  }
  writer.stand(2);
  const Course course(writer.recording(), two_axes(), bound);
  const Cycles cycles = cycles_of(course, {degree, 0.1, 5});
  CHECK(cycles.count == 1);
  REQUIRE(cycles.parts.size() == 11);
  for (const CyclePart& part : cycles.parts) CHECK(part.difference <= degree);
  const std::vector<LogMotion> motions = motions_of(course, cycles, bound, 1);
  REQUIRE(motions.size() == 2);
  CHECK(motions[0].count == 11);
  CHECK(motions[0].rows.front() == motions[0].rows.back());
  CHECK(motions[0].duration() > 7.5);
  CHECK(motions[0].duration() < 8.5 + 3.2);  // including one wait
  CHECK(motions[1].is_rest);
  CHECK(motions[1].duration() == Approx(9).margin(5));  // rests count at most 3 s
  double largest = 0;
  for (const auto& row : motions[1].rows) largest = std::max(largest, -row[0]);
  CHECK(largest / degree == Approx(40).margin(0.1));
  // The motions' shares of the log: count per hour.
  CHECK_THAT(duty_text("shift", "shift/study.yaml", course, motions),
             Contains(fmt::format("repeats_per_hour: {:.6g}", 11 * 3600 / course.log_seconds)));
  LogMotion endless = motions[0];  // leaves no time at rest
  endless.times.back() = course.log_seconds / 10;
  CHECK_THAT(duty_text("shift", "study.yaml", course, {endless}),
             Contains(fmt::format("repeats_per_hour: {:.6g}", 0.99999 * 3600 / endless.duration())));
}

TEST_CASE("log: short cycles have the repeats per hour of the log, because their motions end at samples") {
  for (const double rest : {1.5, 0.45, 0.}) {
    Writer writer(20);
    for (int k = 0; k < 6; ++k) {
      writer.part(5.63, cycle(5.63));
      writer.stand(rest);
    }
    writer.stand(0.05);
    const Recording log = writer.recording();
    const Course course(log, two_axes(), bound);
    const Cycles cycles = cycles_of(course, {degree, 0.1, 5});
    std::vector<LogMotion> motions = motions_of(course, cycles, bound, 8);
    REQUIRE(motions.size() >= 5);           // the last one may lack its end
    for (const double rate : {25., 30.}) {  // 1/30 has more digits than a file
      CAPTURE(rest, rate);
      end_at_samples(motions, rate);
      double simulated = 0, repeats = 0;
      const std::string text = duty_text("shift", "study.yaml", course, motions);
      std::size_t at = 0;
      for (const LogMotion& motion : motions) {
        const double times = std::stod(text.substr(text.find("_hour: ", at = text.find("{job", at + 1)) + 7));
        if (!motion.is_rest) repeats += times;
        simulated += times * std::ceil(std::stod(fmt::format("{:.6f}", motion.duration())) * rate - 1e-9) / rate;
        CHECK(motion.times[motion.times.size() - 2] < motion.times.back());
      }
      CHECK(simulated <= 3600);
      if (rest > 0) CHECK(repeats == Approx(6 * 3600 / course.log_seconds).epsilon(1e-4));
      const auto words = fmt::format("{}", fmt::join(log_words(log, course, cycles, motions), "\n"));
      if (rest > 0) CHECK_THAT(words, !Contains("the log takes"));
      if (rest == 0) CHECK_THAT(words, Contains("the log takes 33.8 s: cycles without a standstill get a stop"));
    }
  }
}

TEST_CASE("log: two products that differ by more than the bound are two cycles") {
  Writer writer(25);
  for (int k = 0; k < 12; ++k) {
    writer.stand(1);
    writer.part(8, cycle(8, k / 4 == 1 ? 0.9 : 1));
  }
  writer.stand(1);
  const Course course(writer.recording(), two_axes(), bound);
  const Cycles cycles = cycles_of(course, {degree, 0.1, 5});
  CHECK(cycles.count == 2);
  std::vector<std::size_t> found;
  for (const CyclePart& part : cycles.parts) found.push_back(part.cycle);
  CHECK(found == std::vector<std::size_t>{0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0});
  // The mean of eight parts of 9 s, of which at most two lack their rest of 1 s, with an error of one interval at either end. A
  // cycle begins after its rest: a ramp would add 0.3 s.
  const double seconds = motions_of(course, cycles, bound, 1)[0].duration();
  CHECK(seconds > 9 - 2. / 8 - 0.08);
  CHECK(seconds < 9 + 0.08);
  CHECK(cycles_of(course, {7 * degree, 0.1, 5}).count == 1);  // they differ by 6 deg
}

TEST_CASE("log: recordings of a cycle stand for parts of other damage") {
  Writer writer(25);
  for (int k = 0; k < 8; ++k) {
    writer.stand(1);
    writer.part(8, cycle(8, k % 2 == 0 ? 1 : 1.01));
  }
  writer.stand(1);
  const Course course(writer.recording(), two_axes(), bound);
  const auto motions = motions_of(course, cycles_of(course, {degree, 0.1, 5}), bound, 2);
  REQUIRE(motions.size() == 2);
  CHECK(motions[0].count + motions[1].count == 8);
  CHECK(motions[1].name == "cycle_1_b");
  const auto largest = [](const LogMotion& motion) {
    double angle = 0;
    for (const auto& row : motion.rows) angle = std::max(angle, row.lpNorm<Eigen::Infinity>());
    return angle;
  };
  CHECK(largest(motions[1]) ==
        Approx(1.01 * largest(motions[0])).epsilon(1e-3));  // rows lie up to 0.04 s from the turning point
  CHECK_THAT(duty_text("shift", "study.yaml", course, motions),
             Contains("{job: cycle_1_b,") && Contains(", recording_of: cycle_1}"));
}

TEST_CASE("log: recordings of a cycle stand for parts of other speed, and long ones are few") {
  const auto motions_with = [](double fast, double slow, int recordings) {
    Writer writer(25);
    for (int k = 0; k < 10; ++k) {
      writer.stand(1);
      const double seconds = k % 2 == 0 ? fast : slow;
      writer.part(seconds, cycle(seconds));
    }
    writer.stand(1);
    const Course course(writer.recording(), two_axes(), bound);
    return motions_of(course, cycles_of(course, {degree, 0.1, 5}), bound, recordings);
  };
  const auto motions = motions_with(8, 8.6, 2);
  REQUIRE(motions.size() == 2);
  CHECK(motions[0].count == 5);
  CHECK(motions[0].duration() > motions[1].duration() + 0.5);  // the slow ones first, whose damage is less
  CHECK(motions_with(8, 8.6, 20).size() == 10);
  CHECK(motions_with(120, 128, 20).size() == 4);  // of 125 s in 600 s
}

TEST_CASE("log: cycles of one way are one within the warp of their times") {
  Writer writer(25);
  for (int k = 0; k < 8; ++k) {
    writer.stand(1);
    const double seconds = k < 4 ? 8 : 8 * 1.3;
    writer.part(seconds, cycle(seconds));
  }
  writer.stand(1);
  const Course course(writer.recording(), two_axes(), bound);
  CHECK(cycles_of(course, {degree, 0.1, 5}).count == 2);
  CHECK(cycles_of(course, {degree, 0.4, 5}).count == 1);
}

}  // namespace dresslife::sim
