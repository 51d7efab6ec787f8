// Longer than 400 lines: what a log must hold is checked beside where it is read, and its messages
// say both.
#include "saca/lab/tune/fit_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "saca/base/core/contract.h"
#include "saca/base/core/csv.h"
#include "saca/base/core/names.h"
#include "saca/base/core/percentile.h"
#include "saca/base/core/units.h"

namespace saca::tune {
namespace {

using vehicle::num_wheels;

constexpr double degree = from_degrees(1.0);
constexpr std::array<SignalInfo, num_signals> signals{{
    {"speed_mps", 1.0, 100.0, 0.0, 0.03},
    {"a_x_mps2", 1.0, 20.0, 0.3, 0.1},
    {"a_y_mps2", 1.0, 20.0, 0.3, 0.1},
    {"yaw_rate_degps", degree, 180.0, 0.5, 0.15},
    {"sideslip_deg", degree, 90.0, 0.5, 0.1},
    {"wheel_front_left_radps", 1.0, 500.0, 0.0, 0.15},
    {"wheel_front_right_radps", 1.0, 500.0, 0.0, 0.15},
    {"wheel_rear_left_radps", 1.0, 500.0, 0.0, 0.15},
    {"wheel_rear_right_radps", 1.0, 500.0, 0.0, 0.15},
}};

constexpr std::string_view time_column = "time_s";
constexpr std::string_view steering_column = "steering_command_deg";
constexpr std::string_view motor_column = "motor_command_Nm";
constexpr std::array<std::string_view, num_wheels> brake_columns{
    "brake_command_front_left_Nm", "brake_command_front_right_Nm", "brake_command_rear_left_Nm",
    "brake_command_rear_right_Nm"};

// Limits of what can be used.
constexpr double shortest_interval = 1e-4;  // [s] between rows
constexpr double longest_interval = 0.05;   // [s]: a car answers within 0.1 s
constexpr double longest_log = 60.0;        // [s]
constexpr double least_speed = 5.0;         // [m/s] before braking or steering
constexpr double stopped = 1.0;             // [m/s] below it a brake test is over
constexpr double quiet = 0.2;               // [s] before the test begins
constexpr double least_after = 0.5;         // [s] from where it begins
constexpr double least_torque = 100.0;      // [N m] of all brakes together: less is none
constexpr double least_step = 0.5 * degree;
constexpr double step_time = 0.25;  // [s] within which a step is made

std::vector<std::string_view> known_columns() {
  std::vector<std::string_view> names{time_column};
  for (const SignalInfo& signal : signals) {
    names.push_back(signal.column);
  }
  names.push_back(steering_column);
  names.insert(names.end(), brake_columns.begin(), brake_columns.end());
  names.push_back(motor_column);
  return names;
}

// What is wrong with a log, first thing first.
class Complaint {
 public:
  explicit Complaint(std::string_view source) : source_(source) {}

  void say(const std::string& message) {
    if (!error_) {
      error_ = Error{Error::Code::malformed, source_ + ": " + message};
    }
  }
  void say(std::size_t line, const std::string& message) {
    if (!error_) {
      error_ = Error{Error::Code::malformed, fmt::format("{}:{}: {}", source_, line, message)};
    }
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  std::string source_;
  std::optional<Error> error_;
};

const std::vector<double>* column(const CsvTable& table, std::string_view name) {
  const auto found = std::find(table.names.begin(), table.names.end(), name);
  const auto index = static_cast<std::size_t>(found - table.names.begin());
  return found == table.names.end() ? nullptr : &table.columns[index];
}

void check_range(const CsvTable& table, std::string_view name, double least, double most,
                 Complaint& complaint) {
  const std::vector<double>* const values = column(table, name);
  for (std::size_t row = 0; values != nullptr && row < values->size(); ++row) {
    if (!((*values)[row] >= least && (*values)[row] <= most)) {
      complaint.say(table.lines[row], fmt::format("{}: want {:g} to {:g}, got {:g}", name, least,
                                                  most, (*values)[row]));
      return;
    }
  }
}

void check_ranges(const CsvTable& table, Complaint& complaint) {
  for (const SignalInfo& signal : signals) {
    check_range(table, signal.column, -signal.largest, signal.largest, complaint);
  }
  check_range(table, steering_column, -60.0, 60.0, complaint);
  constexpr double largest_torque = 50'000.0;  // [N m], as data/vehicles allows
  for (const std::string_view name : brake_columns) {
    check_range(table, name, 0.0, largest_torque, complaint);
  }
  check_range(table, motor_column, -largest_torque, largest_torque, complaint);
}

void check_time(const CsvTable& table, const std::vector<double>& time, Complaint& complaint) {
  constexpr std::size_t least_rows = 20;
  if (time.size() < least_rows) {
    complaint.say(fmt::format("want at least {} rows, got {}", least_rows, time.size()));
    return;
  }
  for (std::size_t row = 1; row < time.size(); ++row) {
    const double interval = time[row] - time[row - 1];
    if (!(interval >= shortest_interval && interval <= longest_interval)) {
      complaint.say(table.lines[row],
                    fmt::format("{}: want {:g} to {:g} s after the row before, got {:g} s",
                                time_column, shortest_interval, longest_interval, interval));
      return;
    }
  }
  if (!(time.back() - time.front() <= longest_log)) {
    complaint.say(fmt::format("want one test of at most {:g} s, got {:g} s", longest_log,
                              time.back() - time.front()));
  }
}

void take_columns(const CsvTable& table, Log& log, Complaint& complaint) {
  log.time = *column(table, time_column);
  log.command.resize(log.time.size());
  for (std::size_t i = 0; i < num_signals; ++i) {
    if (const std::vector<double>* const values = column(table, signals[i].column)) {
      log.measured.push_back({static_cast<Signal>(i), *values});
      for (double& value : log.measured.back().values) {
        value *= signals[i].unit;
      }
    }
  }
  std::size_t num_brakes = 0;
  for (std::size_t wheel = 0; wheel < num_wheels; ++wheel) {
    if (const std::vector<double>* const values = column(table, brake_columns[wheel])) {
      ++num_brakes;
      for (std::size_t row = 0; row < values->size(); ++row) {
        log.command[row].brake_torque[wheel] = (*values)[row];
      }
    }
  }
  if (num_brakes != 0 && num_brakes != num_wheels) {
    complaint.say(
        fmt::format("want {} and the other three wheels, or none of them", brake_columns[0]));
  }
  const std::vector<double>* const steering = column(table, steering_column);
  const std::vector<double>* const motor = column(table, motor_column);
  log.motor_known = motor != nullptr;
  for (std::size_t row = 0; row < log.time.size(); ++row) {
    log.command[row].steering = steering != nullptr ? from_degrees((*steering)[row]) : 0.0;
    log.command[row].motor_torque = motor != nullptr ? (*motor)[row] : 0.0;
  }
}

double brake_sum(const vehicle::Command& command) {
  return std::accumulate(command.brake_torque.begin(), command.brake_torque.end(), 0.0);
}

// Where the largest step begins; nullopt: there is none.
std::optional<std::size_t> step_begin(const Log& log) {
  double largest = least_step * (1.0 - 1e-8);  // exactly the least is a step
  std::optional<std::size_t> begin;
  for (std::size_t row = 0, last = 0; row < log.time.size(); ++row) {
    while (last + 1 < log.time.size() && log.time[last + 1] <= log.time[row] + step_time) {
      ++last;
    }
    const double change = std::abs(log.command[last].steering - log.command[row].steering);
    if (change >= largest * (1.0 + 1e-9)) {
      largest = change;
      begin = row + 1;
    }
  }
  // The last row of those that see the same step stands just before it.
  while (begin && *begin < log.time.size() &&
         log.command[*begin].steering == log.command[*begin - 1].steering) {
    ++*begin;
  }
  return begin;
}

std::optional<std::size_t> brake_begin(const Log& log) {
  const auto first = std::find_if(log.command.begin(), log.command.end(),
                                  [](const auto& one) { return brake_sum(one) >= least_torque; });
  if (first == log.command.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(first - log.command.begin());
}

void find_test(Log& log, Complaint& complaint) {
  const std::optional<std::size_t> braking = brake_begin(log);
  const std::optional<std::size_t> step = step_begin(log);
  if (braking && step) {
    complaint.say("want a brake test or a step steer, got braking and a step of steering in one");
  } else if (!braking && !step) {
    complaint.say(fmt::format(
        "want a brake test or a step steer, got no braking ({} and so on, {:g} N m together) and "
        "no step of {} ({:g} deg within {:g} s)",
        brake_columns[0], least_torque, steering_column, to_degrees(least_step), step_time));
  } else {
    log.kind = braking ? TestKind::brake : TestKind::steer;
    log.event = braking ? *braking : *step;
  }
}

// Rows of a car that stands say nothing more, and sensors that count teeth jump there.
void cut_at_rest(Log& log) {
  const std::vector<double>& speed = log.measured.front().values;
  const auto rest = std::find_if(speed.begin() + static_cast<std::ptrdiff_t>(log.event),
                                 speed.end(), [](double v) { return v < stopped; });
  const auto kept = static_cast<std::size_t>(rest - speed.begin());
  log.time.resize(kept);
  log.command.resize(kept);
  for (Series& series : log.measured) {
    series.values.resize(kept);
  }
}

void check_extent(const Log& log, Complaint& complaint) {
  const double begin = log.time[log.event];
  const std::string_view what = log.kind == TestKind::brake ? "braking" : "the step";
  if (begin - log.time.front() < quiet - 1e-9) {
    complaint.say(fmt::format("want at least {:g} s before {} begins, got {:g} s", quiet, what,
                              begin - log.time.front()));
  }
  if (log.time.back() - begin < least_after - 1e-9) {
    complaint.say(fmt::format("want at least {:g} s of driving after {} begins, got {:g} s",
                              least_after, what, log.time.back() - begin));
  }
}

const std::vector<double>* series_of(const Log& log, Signal signal) {
  const auto found = std::find_if(log.measured.begin(), log.measured.end(),
                                  [signal](const Series& one) { return one.signal == signal; });
  return found == log.measured.end() ? nullptr : &found->values;
}

double median(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  return percentile({values.begin() + static_cast<std::ptrdiff_t>(begin),
                     values.begin() + static_cast<std::ptrdiff_t>(end)},
                    0.5);
}

// First row of the last 0.3 s.
std::size_t settled(const Log& log) {
  constexpr double length = 0.3;  // [s]
  const auto first = std::find_if(log.time.begin(), log.time.end(),
                                  [&log](double time) { return time >= log.time.back() - length; });
  return static_cast<std::size_t>(first - log.time.begin());
}

// What a ratio of two signals that should be one may mean.
std::string hint(double ratio) {
  struct Mistake {
    double ratio;
    std::string_view words;
  };
  constexpr double radian = 1.0 / degree;
  for (const auto& [wrong, words] : {Mistake{3.6, "a speed in km/h"},
                                     {1.0 / 3.6, "a speed in km/h"},
                                     {9.81, "an acceleration in g"},
                                     {1.0 / 9.81, "an acceleration in g"},
                                     {radian, "an angle in rad"},
                                     {1.0 / radian, "an angle in rad"}}) {
    if (std::abs(std::log(std::abs(ratio) / wrong)) < 0.25) {
      return fmt::format("; is {} meant?", words);
    }
  }
  return ratio < 0.0 ? "; is the sign as ISO 8855 has it?" : "; are the units right?";
}

// Speed lost must be what deceleration and brakes can take away.
void check_brake_test(const Log& log, const vehicle::Vehicle& car, Complaint& complaint) {
  const std::vector<double>& speed = log.measured.front().values;
  const std::size_t end = log.time.size();
  const double lost = median(speed, 0, log.event) - median(speed, end - 3, end);
  constexpr double least_lost = 1.0;  // [m/s]
  if (lost < least_lost) {
    complaint.say(fmt::format("speed_mps: want at least {:g} m/s lost by braking, got {:.3g} m/s",
                              least_lost, lost));
    return;
  }
  double impulse = 0.0;  // of the brakes over the mass [m/s]
  double integral = 0.0;
  const std::vector<double>* const a_x = series_of(log, Signal::a_x);
  const double offset = a_x != nullptr ? median(*a_x, 0, log.event) : 0.0;
  for (std::size_t row = log.event; row + 1 < end; ++row) {
    const double interval = log.time[row + 1] - log.time[row];
    impulse += interval * brake_sum(log.command[row]) / (car.wheel_radius * car.mass);
    integral +=
        a_x != nullptr ? 0.5 * interval * ((*a_x)[row] + (*a_x)[row + 1] - 2.0 * offset) : 0.0;
  }
  if (a_x != nullptr && !(-integral > 0.7 * lost && -integral < 1.4 * lost)) {
    complaint.say(
        fmt::format("a_x_mps2: want the speed lost, {:.3g} m/s, as its integral, got {:.3g} m/s{}",
                    lost, -integral, hint(-integral / lost)));
  }
  constexpr double drag = 0.5;  // [m/s^2]: air, rolling, a motor that is let go
  const double most = 1.4 * impulse + drag * (log.time.back() - log.time[log.event]);
  if (lost > most) {
    complaint.say(fmt::format(
        "speed_mps: want at most the {:.3g} m/s that the brakes can take away, got {:.3g} m/s{}",
        most, lost, hint(lost / impulse)));
  }
}

// Steady turning: a_y = v * yaw_rate, and yaw_rate = v * angle / wheelbase, less what the car
// understeers.
void check_step_steer(const Log& log, const vehicle::Vehicle& car, Complaint& complaint) {
  const auto change = [&log](const std::vector<double>& values) {
    return median(values, settled(log), values.size()) - median(values, 0, log.event);
  };
  const std::vector<double>& speed = log.measured.front().values;
  const double yaw_rate = change(*series_of(log, Signal::yaw_rate));
  const double v = median(speed, settled(log), speed.size());
  if (const std::vector<double>* const a_y = series_of(log, Signal::a_y)) {
    const double ratio = change(*a_y) / (v * yaw_rate);
    if (!(ratio > 0.6 && ratio < 1.6)) {
      complaint.say(fmt::format(
          "a_y_mps2: want speed times yaw_rate_degps, {:.3g} m/s2, at the end, got {:.3g} m/s2{}",
          v * yaw_rate, change(*a_y), hint(ratio)));
    }
  }
  const double angle = log.command.back().steering - log.command[log.event - 1].steering;
  const double neutral = v * angle / (car.cg_to_front_axle + car.cg_to_rear_axle);
  const double ratio = yaw_rate / neutral;
  if (!(ratio > 0.15 && ratio < 3.0)) {
    const bool wheel = ratio > 1.0 / 30.0 && ratio <= 0.15;  // a steering gear's 12 to 20 to 1
    complaint.say(fmt::format(
        "yaw_rate_degps: want about {:.3g} deg/s at the end, for {} and the wheelbase, got {:.3g} "
        "deg/s{}",
        to_degrees(neutral), steering_column, to_degrees(yaw_rate),
        wheel ? "; is it the angle of the steering wheel, not of the road wheels?" : hint(ratio)));
  }
}

void check_still_straight(const Log& log, Complaint& complaint) {
  const double speed = median(log.measured.front().values, 0, log.event);
  if (!(speed >= least_speed)) {
    complaint.say(
        fmt::format("speed_mps: want at least {:g} m/s before the test begins, got {:.3g}",
                    least_speed, speed));
  }
  for (std::size_t row = 0; row < log.event; ++row) {
    if (std::abs(log.command[row].steering) > 0.5 * least_step) {
      complaint.say(fmt::format("{}: want straight driving before the test begins, got {:.3g} deg",
                                steering_column, to_degrees(log.command[row].steering)));
      return;
    }
  }
}

}  // namespace

const SignalInfo& info(Signal signal) {
  return signals.at(static_cast<std::size_t>(signal));
}

double value_of(Signal signal, const vehicle::VehicleState& state) {
  switch (signal) {
    case Signal::speed:
      return state.v_B.x;
    case Signal::a_x:
      return state.a_B.x;
    case Signal::a_y:
      return state.a_B.y;
    case Signal::yaw_rate:
      return state.yaw_rate;
    case Signal::sideslip:
      return std::atan2(state.v_B.y, std::max(state.v_B.x, stopped));
    default:
      return state.wheel_speed.at(static_cast<std::size_t>(signal) -
                                  static_cast<std::size_t>(Signal::wheel_front_left));
  }
}

Result<Log> read_log(std::string_view text, std::string_view source, const vehicle::Vehicle& car) {
  const Result<CsvTable> read = read_csv(text, source, known_columns());
  if (!read.has_value()) {
    return read.error();
  }
  const CsvTable& table = read.value();
  Complaint complaint(source);
  for (const std::string_view name : {time_column, info(Signal::speed).column}) {
    if (column(table, name) == nullptr) {
      complaint.say(fmt::format("column {} is missing", name));
    }
  }
  if (!complaint.error()) {
    check_ranges(table, complaint);
    check_time(table, *column(table, time_column), complaint);
  }
  Log log{.name = std::string(source)};
  if (!complaint.error()) {
    take_columns(table, log, complaint);
    find_test(log, complaint);
  }
  if (complaint.error()) {
    return *complaint.error();
  }
  if (log.kind == TestKind::steer && series_of(log, Signal::yaw_rate) == nullptr) {
    complaint.say("column yaw_rate_degps is missing: a step steer needs it");
  }
  if (log.kind == TestKind::brake) {
    cut_at_rest(log);
  }
  if (log.event < log.time.size()) {
    check_extent(log, complaint);
  } else {
    complaint.say("speed_mps: want a car that drives when braking begins");
  }
  if (!complaint.error()) {
    check_still_straight(log, complaint);
  }
  if (!complaint.error()) {
    log.kind == TestKind::brake ? check_brake_test(log, car, complaint)
                                : check_step_steer(log, car, complaint);
  }
  if (complaint.error()) {
    return *complaint.error();
  }
  return log;
}

std::string write_log(const Log& log) {
  expects(!log.measured.empty() && log.command.size() == log.time.size(), "a log with rows");
  std::string text(time_column);
  for (const Series& series : log.measured) {
    text += fmt::format(",{}", info(series.signal).column);
  }
  text += fmt::format(",{}", steering_column);
  for (const std::string_view name : brake_columns) {
    text += fmt::format(",{}", name);
  }
  text += log.motor_known ? fmt::format(",{}\n", motor_column) : "\n";
  for (std::size_t row = 0; row < log.time.size(); ++row) {
    text += fmt::format("{:.6g}", log.time[row]);
    for (const Series& series : log.measured) {
      text += fmt::format(",{:.6g}", series.values[row] / info(series.signal).unit);
    }
    text += fmt::format(",{:.6g}", to_degrees(log.command[row].steering));
    for (const double torque : log.command[row].brake_torque) {
      text += fmt::format(",{:.6g}", torque);
    }
    text += log.motor_known ? fmt::format(",{:.6g}\n", log.command[row].motor_torque) : "\n";
  }
  return text;
}

}  // namespace saca::tune
