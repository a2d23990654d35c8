// Time stamps of logs, converted to seconds: numbers (s, ms, us, ns, min or h), dates with times of day, times of day only.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dresslife::sim {

/// Dates: 2027-03-01, 2027/03/01, 01.03.2027, 01-03-2027, and 03/01/2027 with the month first. Times of day:
/// 08:15:30.125 or with a comma, with Z or +01:00, or AM and PM. Between date and time: a blank or T.
class LogTime {
 public:
  /// seconds: seconds per unit of numbers; absent: the size of the first number decides (unit_of_clock).
  explicit LogTime(std::optional<double> seconds) : unit_(seconds) {}

  /// Returns seconds from a fixed begin. A time of day more than 12 h before the previous one belongs to the next day.
  /// Absent: the text is no time.
  std::optional<double> read(std::string_view text);
  /// Returns the format of the last time: "numbers in ms", "dates with times of day".
  std::string words() const;

 private:
  enum class Form { numbers, dates, times_of_day } form_ = Form::numbers;
  std::optional<double> unit_;
  double days_ = 0;  ///< number of midnights since the first time of day, times 86,400 s
  std::optional<double> last_of_day_;
};

}  // namespace dresslife::sim
