#include "saca/lab/intention_scoring/lead_time.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/base/core/percentile.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_scoring {
namespace {

using intent::Intention;

/// An alarm so long before or after the label is not false.
constexpr std::size_t alarm_slack = 10;  // frames: 1 s

enum class Kind : std::uint8_t { left, right, braking };

bool names(std::size_t of, Kind kind) {
  const auto intention = static_cast<Intention>(of);
  switch (kind) {
    case Kind::left:
      return intention == Intention::lane_left || intention == Intention::brake_left;
    case Kind::right:
      return intention == Intention::lane_right || intention == Intention::brake_right;
    case Kind::braking:
      return intention == Intention::brake || intention == Intention::brake_left ||
             intention == Intention::brake_right;
  }
  return false;
}

/// Whether what any of these heads names is of the kind.
bool predicted(const Forecasts& forecasts, std::span<const std::size_t> heads, std::size_t frame,
               Kind kind) {
  return std::any_of(heads.begin(), heads.end(),
                     [&](std::size_t head) { return names(forecasts.named(head, frame), kind); });
}

/// The last frame at or before an instant; nullopt: the instant is outside the sequence.
std::optional<std::size_t> frame_before(const Sequence& sequence, double time) {
  constexpr double rounding = 1e-9;  // of multiples of 0.1 s
  const double place = std::floor(time / frame_step + rounding);
  if (!(place >= 0.0) || place >= static_cast<double>(sequence.labels.size())) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(place);
}

/// @param first  frames before it do not count
double lead_time(const Forecasts& forecasts, std::span<const std::size_t> heads, Kind kind,
                 double event, std::size_t first, std::size_t last) {
  std::size_t begun = last + 1;
  while (begun > first && predicted(forecasts, heads, begun - 1, kind)) {
    --begun;
  }
  return begun > last ? 0.0 : std::max(0.0, event - static_cast<double>(begun) * frame_step);
}

void expect_both(const Sequence& sequence, const Forecasts& forecasts) {
  expect_whole(sequence);
  expect_forecasts_of(sequence, forecasts);
}

/// @param kind_of  what an event is, by the label of the last frame before it; nullopt: it is of no
///                 kind, and not labelled
template <class KindOf>
LeadTimes lead_times_of(const Sequence& sequence, const Forecasts& forecasts,
                        std::span<const double> events, std::span<const std::size_t> heads,
                        const KindOf& kind_of) {
  expect_both(sequence, forecasts);
  LeadTimes lead_times;
  std::size_t first = 0;
  for (const double event : events) {
    const auto last = frame_before(sequence, event);
    const std::optional<Kind> kind = last ? kind_of(sequence.labels[*last]) : std::nullopt;
    if (kind) {
      lead_times.times.push_back(
          lead_time(forecasts, heads, *kind, event, std::min(first, *last), *last));
    } else {
      ++lead_times.unlabelled;
    }
    first = last ? *last + 1 : first;
  }
  return lead_times;
}

bool labelled_near(const Sequence& sequence, std::size_t begin, std::size_t end, Kind kind) {
  const std::size_t from = begin - std::min(begin, alarm_slack);
  const std::size_t to = std::min(sequence.labels.size(), end + alarm_slack);
  for (std::size_t t = from; t < to; ++t) {
    if (names(sequence.labels[t], kind)) {
      return true;
    }
  }
  return false;
}

bool scored_within(const Sequence& sequence, std::size_t begin, std::size_t end) {
  for (std::size_t t = begin; t < end; ++t) {
    if (sequence.scored[t]) {
      return true;
    }
  }
  return false;
}

std::size_t false_alarms_of(const Sequence& sequence, const Forecasts& forecasts, Kind kind) {
  constexpr std::array<std::size_t, 1> now{0};
  const std::size_t frames = sequence.labels.size();
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < frames; ++begin) {
    std::size_t end = begin;
    while (end < frames && predicted(forecasts, now, end, kind)) {
      ++end;
    }
    if (end > begin && scored_within(sequence, begin, end) &&
        !labelled_near(sequence, begin, end, kind)) {
      ++count;
    }
    begin = std::max(begin, end);  // the frame at `end` is of another kind
  }
  return count;
}

}  // namespace

void LeadTimes::add(const LeadTimes& other) {
  times.insert(times.end(), other.times.begin(), other.times.end());
  unlabelled += other.unlabelled;
}

std::optional<double> LeadTimes::share_predicted() const {
  if (times.empty()) {
    return std::nullopt;
  }
  const auto warned = std::count_if(times.begin(), times.end(), [](double t) { return t > 0.0; });
  return static_cast<double>(warned) / static_cast<double>(times.size());
}

std::optional<double> LeadTimes::quantile(double share) const {
  return times.empty() ? std::nullopt : std::optional<double>(percentile(times, share));
}

LeadTimes lane_change_lead_times(const Sequence& sequence, const Forecasts& forecasts) {
  constexpr std::array<std::size_t, 2> heads{0, num_heads - 1};
  return lead_times_of(sequence, forecasts, sequence.crossing_times, heads,
                       [](std::uint8_t label) -> std::optional<Kind> {
                         return names(label, Kind::left)    ? std::optional(Kind::left)
                                : names(label, Kind::right) ? std::optional(Kind::right)
                                                            : std::nullopt;
                       });
}

LeadTimes braking_lead_times(const Sequence& sequence, const Forecasts& forecasts) {
  constexpr std::array<std::size_t, num_heads> heads{0, 1, 2};
  return lead_times_of(sequence, forecasts, sequence.braking_times, heads,
                       [](std::uint8_t) { return std::optional(Kind::braking); });
}

FalseAlarms& FalseAlarms::operator+=(const FalseAlarms& other) {
  left += other.left;
  right += other.right;
  braking += other.braking;
  hours += other.hours;
  return *this;
}

std::optional<double> FalseAlarms::per_hour() const {
  if (!(hours > 0.0)) {
    return std::nullopt;
  }
  return static_cast<double>(left + right + braking) / hours;
}

FalseAlarms false_alarms(const Sequence& sequence, const Forecasts& forecasts) {
  expect_both(sequence, forecasts);
  constexpr double seconds_per_hour = 3600.0;
  return {.left = false_alarms_of(sequence, forecasts, Kind::left),
          .right = false_alarms_of(sequence, forecasts, Kind::right),
          .braking = false_alarms_of(sequence, forecasts, Kind::braking),
          .hours = static_cast<double>(sequence.labels.size()) * frame_step / seconds_per_hour};
}

std::size_t illegal_steps(std::span<const std::uint8_t> classes, const ForbiddenSteps& forbidden) {
  expects(std::all_of(classes.begin(), classes.end(),
                      [](std::uint8_t c) { return c < num_vehicle_classes; }),
          "classes of vehicles");
  std::size_t count = 0;
  for (std::size_t t = 1; t < classes.size(); ++t) {
    count += forbidden.at(classes[t - 1]).at(classes[t]) ? 1U : 0U;
  }
  return count;
}

}  // namespace saca::intention_scoring
