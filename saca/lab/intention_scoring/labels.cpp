#include "saca/lab/intention_scoring/labels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "saca/base/core/contract.h"
#include "saca/lab/intention_scoring/sequence.h"
#include "saca/thinking/intent/intention.h"

namespace saca::intention_scoring {
namespace {

using intent::Intention;

enum class Membership : std::uint8_t { no, doubtful, yes };

std::size_t frames_of(double time) {
  return static_cast<std::size_t>(std::lround(time / frame_step));
}

/// Frames [first, last).
struct Span {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The longest spans in which `holds(i)`.
template <class Holds>
std::vector<Span> spans_where(std::size_t size, Holds&& holds) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < size; ++i) {
    if (!holds(i)) {
      continue;
    }
    if (found.empty() || found.back().last != i) {
      found.push_back({i, i});
    }
    found.back().last = i + 1;
  }
  return found;
}

/// Per frame: is it in an act of this kind?
using Verdicts = std::vector<Membership>;

void mark(Verdicts& verdicts, const Span& span, Membership judged) {
  for (std::size_t i = span.first; i < span.last; ++i) {
    verdicts[i] = std::max(verdicts[i], judged);
  }
}

/// Out and back: half of the way or more is lost again soon after, or was lost shortly before.
bool is_undone(const TrueMotion& motion, const LabelRule& rule, double side, const Span& move) {
  const std::vector<double>& lateral = motion.lateral;
  const double end = lateral[move.last - 1];
  const double begin = lateral[move.first];
  const double half = 0.5 * side * (end - begin);
  const std::size_t near = frames_of(rule.undone_within);
  for (std::size_t i = move.last; i < std::min(lateral.size(), move.last + near); ++i) {
    if (side * (end - lateral[i]) > half) {
      return true;
    }
  }
  for (std::size_t i = move.first - std::min(move.first, near); i < move.first; ++i) {
    if (side * (lateral[i] - begin) > half) {
      return true;
    }
  }
  return false;
}

/// Into another lane, or fast.
bool is_manoeuvre(const TrueMotion& motion, const LabelRule& rule, double side, const Span& move) {
  const auto lane = [&](std::size_t i) {
    return std::round(motion.lateral[i] / motion.lane_width);
  };
  if (lane(move.first) != lane(move.last - 1)) {
    return true;
  }
  for (std::size_t i = move.first; i < move.last; ++i) {
    if (side * motion.lateral_speed[i] >= rule.swerve) {
      return true;
    }
  }
  return false;
}

Membership judge_move(const TrueMotion& motion, const LabelRule& rule, double side,
                      const Span& move) {
  const double way = side * (motion.lateral[move.last - 1] - motion.lateral[move.first]);
  const bool cut = move.first == 0 || move.last == motion.lateral.size() ||
                   std::isnan(motion.lateral_speed[move.first - 1]) ||
                   std::isnan(motion.lateral_speed[move.last]);
  if (way >= rule.least_way) {
    return is_manoeuvre(motion, rule, side, move) && !is_undone(motion, rule, side, move)
               ? Membership::yes
               : Membership::doubtful;
  }
  return way >= rule.doubtful_way || cut ? Membership::doubtful : Membership::no;
}

/// @param side  1 to the left, -1 to the right
Verdicts moves(const TrueMotion& motion, const LabelRule& rule, double side) {
  Verdicts verdicts(motion.lateral.size(), Membership::no);
  const auto speed = [&](std::size_t i) { return side * motion.lateral_speed[i]; };
  for (const Span& whole : spans_where(motion.lateral.size(),
                                       [&](std::size_t i) { return speed(i) > rule.aside_end; })) {
    std::size_t begin = whole.first;
    while (begin < whole.last && !(speed(begin) > rule.aside_begin)) {
      ++begin;
    }
    const Membership judged = judge_move(motion, rule, side, whole);
    mark(verdicts, {whole.first, begin},
         judged == Membership::no ? Membership::no : Membership::doubtful);
    mark(verdicts, {begin, whole.last}, judged);
  }
  return verdicts;
}

Membership judge_braking(const TrueMotion& motion, const LabelRule& rule, const Span& span) {
  std::size_t longest = 0;
  std::size_t longest_doubtful = 0;
  std::size_t now = 0;
  std::size_t now_doubtful = 0;
  double loss = 0.0;
  for (std::size_t i = span.first; i < span.last; ++i) {
    now = motion.acceleration[i] <= rule.braking ? now + 1 : 0;
    now_doubtful = motion.acceleration[i] <= rule.doubtful_braking ? now_doubtful + 1 : 0;
    longest = std::max(longest, now);
    longest_doubtful = std::max(longest_doubtful, now_doubtful);
    loss -= motion.acceleration[i] * frame_step;
  }
  if (longest >= frames_of(rule.least_braking) && loss >= rule.least_loss) {
    return Membership::yes;
  }
  const bool cut = span.first == 0 || span.last == motion.acceleration.size();
  return longest_doubtful >= frames_of(rule.least_braking) || cut ? Membership::doubtful
                                                                  : Membership::no;
}

Verdicts brakings(const TrueMotion& motion, const LabelRule& rule, std::vector<double>& times) {
  Verdicts verdicts(motion.acceleration.size(), Membership::no);
  for (const Span& span : spans_where(motion.acceleration.size(), [&](std::size_t i) {
         return motion.acceleration[i] < rule.braking_end;
       })) {
    const Membership judged = judge_braking(motion, rule, span);
    if (judged != Membership::yes) {
      mark(verdicts, span, judged);
      continue;
    }
    std::size_t begin = span.first;
    while (motion.acceleration[begin] > rule.braking) {
      ++begin;
    }
    mark(verdicts, {span.first, begin}, Membership::doubtful);
    mark(verdicts, {begin, span.last}, Membership::yes);
    times.push_back(static_cast<double>(begin) * frame_step);
  }
  return verdicts;
}

Intention class_of(bool left, bool right, bool braking) {
  if (left) {
    return braking ? Intention::brake_left : Intention::lane_left;
  }
  if (right) {
    return braking ? Intention::brake_right : Intention::lane_right;
  }
  return braking ? Intention::brake : Intention::maintain;
}

}  // namespace

Labels labels_of(const TrueMotion& motion, const LabelRule& rule) {
  const std::size_t size = motion.acceleration.size();
  expects(motion.lateral.size() == size && motion.lateral_speed.size() == size,
          "one number of each kind per frame");
  Labels labels{.classes = std::vector<std::uint8_t>(size),
                .scored = std::vector<bool>(size, true),
                .braking_times = {}};
  const Verdicts left = moves(motion, rule, 1.0);
  const Verdicts right = moves(motion, rule, -1.0);
  const Verdicts braking = brakings(motion, rule, labels.braking_times);
  for (std::size_t i = 0; i < size; ++i) {
    labels.classes[i] = static_cast<std::uint8_t>(class_of(
        left[i] == Membership::yes, right[i] == Membership::yes, braking[i] == Membership::yes));
    for (const Verdicts* each : {&left, &right, &braking}) {
      if ((*each)[i] == Membership::doubtful) {
        labels.scored[i] = false;
      }
    }
  }
  const std::size_t around = frames_of(rule.around_change);
  for (std::size_t i = 1; i < size; ++i) {
    if (labels.classes[i] == labels.classes[i - 1]) {
      continue;
    }
    for (std::size_t j = i - std::min(i, around); j < std::min(size, i + around); ++j) {
      labels.scored[j] = false;
    }
  }
  return labels;
}

}  // namespace saca::intention_scoring
