#pragma once

#include <algorithm>

namespace saca::collision {

/// Two times, and what is between them: positive before, not so after.
struct Bracket {
  double before = 0.0;  ///< [s]
  double high = 0.0;    ///< the value then, > 0
  double after = 0.0;   ///< [s]
  double low = 0.0;     ///< the value then, <= 0
};

/// The last time at which something is still positive that is so at the bracket's beginning, but
/// not at its end: to `least_time` [s], or until it is less than `enough` there. `value` may bend,
/// not jump.
///
/// False position; of an end that stays the weight is halved (the Illinois rule), and now and then
/// the interval is.
template <class Value>
[[nodiscard]] double last_positive(Bracket bracket, double least_time, double enough,
                                   const Value& value) {
  auto& [before, high, after, low] = bracket;
  double high_weight = high;
  double low_weight = low;
  int stays = 0;  // > 0: `after` did, < 0: `before` did
  for (int i = 0; i < 60 && after - before > least_time && high > enough; ++i) {
    const double share =
        high_weight > low_weight && i % 4 != 3 ? high_weight / (high_weight - low_weight) : 0.5;
    const double middle = before + std::clamp(share, 0.001, 0.999) * (after - before);
    const double now = value(middle);
    if (now > 0.0) {
      low_weight = stays > 0 ? 0.5 * low_weight : low;
      stays = 1;
      before = middle;
      high = high_weight = now;
    } else {
      high_weight = stays < 0 ? 0.5 * high_weight : high;
      stays = -1;
      after = middle;
      low = low_weight = now;
    }
  }
  return before;
}

}  // namespace saca::collision
