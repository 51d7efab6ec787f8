#include "saca/onboard/collision/approach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"
#include "saca/onboard/collision/gap.h"

namespace saca::collision {
namespace {

using world::Footprint;
using world::Separation;
using world::Shape;
using world::Track;

constexpr double distance_accuracy = 5e-4;  // of the smallest distance; half the promised 1 mm
constexpr double least_travel = 1e-6;       // of both together in one step [m]
constexpr double infinity = std::numeric_limits<double>::infinity();

// Both bodies at one time. The gap is seen from the first one's origin, so that digits are not lost
// far from the world's.
struct BodiesAtTime {
  double time = 0.0;
  Pose X_WA;
  Pose X_WB;
  Separation gap;
};

BodiesAtTime bodies_at(const Mover& a, const Mover& b, double time) {
  const Pose X_WA = pose_at(a.track(), time);
  const Pose X_WB = pose_at(b.track(), time);
  return {time, X_WA, X_WB,
          separation(a.footprint(), {{}, X_WA.yaw}, b.footprint(), {X_WB.p - X_WA.p, X_WB.yaw})};
}

// Bound on how fast the distance shrinks on the way from one moment to another, forwards or
// backwards in time, within which both bodies move straight and turn evenly [m/s].
double closing_speed(const Mover& a, const Mover& b, const BodiesAtTime& from,
                     const BodiesAtTime& to) {
  const Vec2 n_W = (1.0 / from.gap.distance) * (from.gap.p_b_W - from.gap.p_a_W);
  const double closing = dot(n_W, (to.X_WA.p - from.X_WA.p) - (to.X_WB.p - from.X_WB.p));
  const double turning = std::abs(wrap_angle(to.X_WA.yaw - from.X_WA.yaw)) * a.reach() +
                         std::abs(wrap_angle(to.X_WB.yaw - from.X_WB.yaw)) * b.reach();
  return (closing + turning) / std::abs(to.time - from.time);
}

// Where they touch on the way from a moment apart to one where they overlap: still apart.
BodiesAtTime touching_between(const Mover& a, const Mover& b, BodiesAtTime from, BodiesAtTime to) {
  while (from.gap.distance > touching) {
    const double time = 0.5 * (from.time + to.time);
    if (time <= from.time || time >= to.time) {
      break;  // no time lies between
    }
    const BodiesAtTime middle = bodies_at(a, b, time);
    (middle.gap.distance > 0.0 ? from : to) = middle;
  }
  return from;
}

// The longest step from `now` on the straight way to `corner` that cannot lead past a contact, but
// at least one that makes headway.
double stride(const BodiesAtTime& now, double closing, double top_speed) {
  const double safe = (now.gap.distance - 0.5 * touching) / closing;
  const double tick = 4.0 * std::numeric_limits<double>::epsilon() * (1.0 + std::abs(now.time));
  return std::max({safe, least_travel / top_speed, tick});
}

void note(const BodiesAtTime& bodies_at, Approach& found) {
  if (bodies_at.gap.distance < found.distance) {
    found.distance = bodies_at.gap.distance;
    found.nearest_at = bodies_at.time;
  }
}

// Notes the smallest distance between two moments of a straight segment, as far as it is below what
// was found. The distance lies above a line that falls from either end; where the lines meet too
// low, look there.
void note_between(const Mover& a, const Mover& b, const BodiesAtTime& from, const BodiesAtTime& to,
                  int depth, Approach& found) {
  note(from, found);
  note(to, found);
  const double forward = closing_speed(a, b, from, to);
  const double backward = closing_speed(a, b, to, from);
  if (depth == 0 || forward <= 0.0 || backward <= 0.0) {
    return;
  }
  const double span = to.time - from.time;
  const double meet = std::clamp(
      (from.gap.distance - to.gap.distance + backward * span) / (forward + backward), 0.0, span);
  if (from.gap.distance - forward * meet >= found.distance - distance_accuracy) {
    return;
  }
  const BodiesAtTime middle = bodies_at(a, b, from.time + 0.5 * span);
  note_between(a, b, from, middle, depth - 1, found);
  note_between(a, b, middle, to, depth - 1, found);
}

// Where along t_W the points lie that are within `depth` of the foremost along n_W.
struct Span {
  double low = infinity;
  double high = -infinity;

  void add(double at) {
    low = std::min(low, at);
    high = std::max(high, at);
  }
};

Span front_of_box(const Footprint& box, const Pose& X_WB, Vec2 n_W, Vec2 t_W, double depth) {
  const auto [a, b] = half_axes(box);
  std::array<Vec2, 4> corners{Vec2{a, b}, Vec2{-a, b}, Vec2{-a, -b}, Vec2{a, -b}};
  for (Vec2& corner : corners) {
    corner = X_WB * (corner + Vec2{box.centre_x, 0.0});
  }
  const double limit = dot(n_W, support(box, X_WB, n_W)) - depth;
  Span span;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 p = corners[i];
    const Vec2 q = corners[(i + 1) % 4];
    const double above_p = dot(n_W, p) - limit;
    const double above_q = dot(n_W, q) - limit;
    if (above_p >= 0.0) {
      span.add(dot(t_W, p));
    }
    if ((above_p >= 0.0) != (above_q >= 0.0)) {
      const double share = above_p / (above_p - above_q);
      span.add(dot(t_W, p + share * (q - p)));
    }
  }
  return span;
}

// On the unit circle that the ellipse is an image of, the limit is a chord.
Span front_of_ellipse(const Footprint& ellipse, const Pose& X_WB, Vec2 n_W, Vec2 t_W,
                      double depth) {
  const auto [a, b] = half_axes(ellipse);
  const Vec2 n_B = rotated(n_W, -X_WB.yaw);
  const Vec2 m{a * n_B.x, b * n_B.y};
  const double height = norm(m);
  const Vec2 top = (1.0 / height) * m;
  const double chord = std::max(1.0 - depth / height, 0.0);
  const double half = std::sqrt(1.0 - chord * chord);
  Span span;
  for (const double side : {-half, half}) {
    const Vec2 u = chord * top + side * Vec2{-top.y, top.x};
    span.add(dot(t_W, X_WB * (Vec2{a * u.x, b * u.y} + Vec2{ellipse.centre_x, 0.0})));
  }
  return span;
}

Span front(const Footprint& body, const Pose& X_WB, Vec2 n_W, Vec2 t_W, double depth) {
  return body.shape == Shape::ellipse ? front_of_ellipse(body, X_WB, n_W, t_W, depth)
                                      : front_of_box(body, X_WB, n_W, t_W, depth);
}

// Narrower gaps have no direction that rounding leaves alone [m].
constexpr double least_gap = 1e-6;

// Bodies near the world's origin.
Touch touch_here(const Footprint& a, const Pose& X_WA, const Footprint& b, const Pose& X_WB,
                 double depth) {
  const Separation gap = separation(a, X_WA, b, X_WB);
  const Vec2 way_W = gap.p_b_W - gap.p_a_W;
  const Vec2 n_W = (1.0 / norm(way_W)) * way_W;
  const Vec2 t_W{-n_W.y, n_W.x};
  const Span of_a = front(a, X_WA, n_W, t_W, depth);
  const Span of_b = front(b, X_WB, -n_W, t_W, depth);
  const double middle = 0.5 * (std::max(of_a.low, of_b.low) + std::min(of_a.high, of_b.high));
  return {0.5 * dot(n_W, gap.p_a_W + gap.p_b_W) * n_W + middle * t_W, n_W};
}

Footprint shrunk(Footprint body, double share) {
  body.length *= share;
  body.width *= share;
  return body;
}

/// The largest size at which two boxes are apart, shrunk about their centres: that along the axis
/// on which they part first.
double apart_boxes(const Footprint& a, const Pose& X_WA, const Footprint& b, const Pose& X_WB) {
  const Body body_a = body_at(a, X_WA);
  const Body body_b = body_at(b, X_WB);
  double share = 0.0;
  for (const Gap& gap : gaps_along_axes(body_a, body_b)) {
    const double centres = dot(body_b.centre - body_a.centre, gap.n);
    share = std::max(share, (centres - 1.001 * least_gap) / (centres - gap.size));
  }
  return std::min(share, 1.0);
}

/// Likewise of any two, found by halving.
double apart_bodies(const Footprint& a, const Pose& X_WA, const Footprint& b, const Pose& X_WB) {
  double apart = 0.0;  // concentric bodies never part
  double overlapping = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double share = 0.5 * (apart + overlapping);
    const bool part =
        separation(shrunk(a, share), X_WA, shrunk(b, share), X_WB).distance > least_gap;
    (part ? apart : overlapping) = share;
  }
  return apart;
}

const Track& checked(const Track& track) {
  expects(!track.X_WA.empty(), "a track has at least one pose");
  expects(track.step > 0.0 && std::isfinite(track.start), "step > 0 and start is finite");
  for (const Pose& pose : track.X_WA) {
    expects(is_finite(pose), "every pose is finite");
  }
  return track;
}

}  // namespace

Mover::Mover(const Footprint& footprint, const Track& X_WA)
    : footprint_(&footprint),
      track_(&X_WA),
      reach_(bounding_radius(footprint)),
      boxes_(footprint, checked(X_WA)) {
  const auto& poses = X_WA.X_WA;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double turn = std::abs(wrap_angle(poses[i].yaw - poses[i - 1].yaw));
    const double way = norm(poses[i].p - poses[i - 1].p) + turn * reach_;
    top_speed_ = std::max(top_speed_, way / X_WA.step);
  }
}

double Mover::next_sample(double time) const {
  // A time that rounding left just before a sample stands for that sample.
  const double sample = std::floor((time - track_->start) / track_->step + 1e-6) + 1.0;
  const auto last = static_cast<double>(track_->X_WA.size() - 1);
  return sample > last ? infinity : track_->start + std::max(sample, 0.0) * track_->step;
}

Approach approach(const Mover& a, const Mover& b, double start, double end, double of_interest) {
  expects(std::isfinite(start) && start <= end && std::isfinite(end), "start <= end");
  expects(of_interest >= 0.0, "of_interest >= 0");
  const double top_speed = a.top_speed() + b.top_speed();
  Approach found{.distance = of_interest};
  if (!may_come_near(a.boxes(), b.boxes(), start, end, std::max(of_interest, touching))) {
    return found;
  }
  BodiesAtTime now = bodies_at(a, b, start);
  while (true) {
    const double distance = now.gap.distance;
    // May be used up and nothing be missed, neither a smaller distance nor a touch.
    const double spare = distance - std::max(found.distance, 0.5 * touching);
    note(now, found);
    if (distance <= touching) {
      found.contact = now.time;
      return found;
    }
    if (now.time >= end || (spare > 0.0 && top_speed * (end - now.time) <= spare)) {
      return found;
    }
    const double corner = std::min({a.next_sample(now.time), b.next_sample(now.time), end});
    if (spare > touching && now.time + spare / top_speed > corner) {
      now = bodies_at(a, b, now.time + spare / top_speed);
      continue;
    }
    BodiesAtTime next = bodies_at(a, b, corner);
    const double closing = closing_speed(a, b, now, next);
    if (closing * (corner - now.time) > distance - 0.5 * touching) {
      next = bodies_at(a, b, std::min(corner, now.time + stride(now, closing, top_speed)));
    }
    if (next.gap.distance <= 0.0) {
      now = touching_between(a, b, now, next);
      note(now, found);
      found.contact = now.time;
      return found;
    }
    note_between(a, b, now, next, 10, found);
    now = next;
  }
}

Touch touch(const Footprint& a, const Pose& X_WA, const Footprint& b, const Pose& X_WB,
            double depth) {
  expects(depth > 0.0, "depth > 0");
  const Pose here{{}, X_WA.yaw};
  const Pose there{X_WB.p - X_WA.p, X_WB.yaw};
  double apart = 1.0;
  if (separation(a, here, b, there).distance <= least_gap) {
    const bool boxes = a.shape == Shape::box && b.shape == Shape::box;
    apart = boxes ? apart_boxes(a, here, b, there) : apart_bodies(a, here, b, there);
  }
  if (apart < 1e-6) {
    const Vec2 p_W = X_WA * Vec2{a.centre_x, 0.0};
    return {p_W, rotated({1.0, 0.0}, X_WA.yaw)};  // no side is nearer than another: ahead
  }
  const Touch at = touch_here(shrunk(a, apart), here, shrunk(b, apart), there, depth);
  return {X_WA.p + at.p_W, at.n_W};
}

Vec2 foremost(const Footprint& body, const Pose& X_WB, Vec2 n_W, double depth) {
  const Vec2 t_W{-n_W.y, n_W.x};
  const Span span = front(body, X_WB, n_W, t_W, depth);
  return dot(n_W, support(body, X_WB, n_W)) * n_W + 0.5 * (span.low + span.high) * t_W;
}

}  // namespace saca::collision
