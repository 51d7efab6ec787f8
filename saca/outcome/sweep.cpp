#include "saca/outcome/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "saca/world/footprint.h"

namespace saca::outcome {
namespace {

using manoeuvre::AtlasInstant;
using world::Footprint;
using world::Shape;
using world::Track;

constexpr double goes_on_for = 2.0;   // as in play_out.cpp [s]
constexpr double least_step = 0.01;   // [s]
constexpr double still = 0.05;        // [m/s]
constexpr double most_change = 20.0;  // of the two velocities against each other [m/s^2]
constexpr double jump = 1.0;          // that a walker's track may make at once [m/s]
constexpr double sure_sd = 4.0;       // beyond so many standard deviations nothing happens

// A footprint somewhere, its direction as cosine and sine.
struct Body {
  bool round = false;
  Vec2 half;
  Vec2 centre;
  Vec2 along;
};

Body body_at(const Footprint& footprint, const Pose& X_WB) noexcept {
  const Vec2 along{std::cos(X_WB.yaw), std::sin(X_WB.yaw)};
  return {footprint.shape == Shape::ellipse, half_axes(footprint),
          X_WB.p + footprint.centre_x * along, along};
}

Vec2 left_of(Vec2 a) noexcept {
  return {-a.y, a.x};
}

// How far the body reaches along a unit vector.
double reach_along(const Body& body, Vec2 n) noexcept {
  const double x = body.half.x * dot(n, body.along);
  const double y = body.half.y * dot(n, left_of(body.along));
  return body.round ? std::sqrt(x * x + y * y) : std::abs(x) + std::abs(y);
}

// The widest gap along some directions: never more than the distance; of boxes that overlap, how
// deep.
struct Gap {
  double size = -std::numeric_limits<double>::infinity();
  Vec2 n;  // from a to b
};

void look_along(const Body& a, const Body& b, Vec2 n, Gap& gap) noexcept {
  const double apart = dot(b.centre - a.centre, n);
  const double size = std::abs(apart) - reach_along(a, n) - reach_along(b, n);
  if (size > gap.size) {
    gap = {size, apart < 0.0 ? -n : n};
  }
}

// From the nearest point of a box to the middle of what is round.
void look_from_box(const Body& box, const Body& round, const Body& a, const Body& b,
                   Gap& gap) noexcept {
  const Vec2 way = round.centre - box.centre;
  const Vec2 across = left_of(box.along);
  const double x = dot(way, box.along);
  const double y = dot(way, across);
  const Vec2 off = (x - std::clamp(x, -box.half.x, box.half.x)) * box.along +
                   (y - std::clamp(y, -box.half.y, box.half.y)) * across;
  const double size = std::sqrt(dot(off, off));
  if (size > 0.0) {
    look_along(a, b, (1.0 / size) * off, gap);
  }
}

Gap gap_between(const Body& a, const Body& b) noexcept {
  Gap gap;
  look_along(a, b, a.along, gap);
  look_along(a, b, left_of(a.along), gap);
  look_along(a, b, b.along, gap);
  look_along(a, b, left_of(b.along), gap);
  if (b.round) {
    look_from_box(a, b, a, b, gap);
  }
  if (a.round) {
    look_from_box(b, a, a, b, gap);
  }
  if (!(gap.size > -std::numeric_limits<double>::infinity())) {
    gap.size = std::numeric_limits<double>::infinity();  // what is no number touches nobody
  }
  return gap;
}

double normal_below(double x) noexcept {
  return 0.5 * std::erfc(-x * std::sqrt(0.5));
}

// The mean and spread of what wrong grip adds along a direction, where less grip adds `less` per
// standard deviation and more `more`: two halves of normal distributions.
struct Spread {
  double mean = 0.0;
  double variance = 0.0;
};
Spread of_halves(double less, double more) noexcept {
  const double mean = (less + more) / std::sqrt(2.0 * std::numbers::pi);
  return {mean, 0.5 * (less * less + more * more) - mean * mean};
}

constexpr double large = 1e9;  // [m]

double reach_of(const Footprint& footprint) noexcept {
  const Vec2 half = half_axes(footprint);
  const double x = half.x + std::abs(footprint.centre_x);
  return std::sqrt(x * x + half.y * half.y);
}

void begin(Boxes& boxes) noexcept {
  boxes.low.fill({large, large});
  boxes.high.fill({-large, -large});
}

std::size_t piece_at(double time) noexcept {
  return static_cast<std::size_t>(
      std::clamp(time * (1.0 / Boxes::piece), 0.0, static_cast<double>(Boxes::count - 1)));
}

// From one place to another, and `margin` around, during all pieces between two times.
void cover(Boxes& boxes, double from, double to, Vec2 p, Vec2 q, double margin) noexcept {
  const std::size_t last = piece_at(to);
  for (std::size_t i = piece_at(from); i <= last; ++i) {
    Vec2& low = boxes.low[i];
    Vec2& high = boxes.high[i];
    low = {std::min({low.x, p.x - margin, q.x - margin}),
           std::min({low.y, p.y - margin, q.y - margin})};
    high = {std::max({high.x, p.x + margin, q.x + margin}),
            std::max({high.y, p.y + margin, q.y + margin})};
  }
}

double distance_between(const Boxes& a, const Boxes& b, std::size_t i) noexcept {
  const double x = std::max({0.0, b.low[i].x - a.high[i].x, a.low[i].x - b.high[i].x});
  const double y = std::max({0.0, b.low[i].y - a.high[i].y, a.low[i].y - b.high[i].y});
  return std::sqrt(x * x + y * y);
}

// A track at one time, found once.
struct OnTrack {
  Pose X_WA;
  Vec2 v_W;
  double yaw_rate = 0.0;
};
OnTrack on_track(const Track& track, double time) noexcept {
  const auto last = static_cast<double>(track.X_WA.size() - 1);
  const double place = (time - track.start) / track.step;
  if (!(place >= 0.0 && place <= last) || last < 1.0) {
    return {place > 0.0 ? track.X_WA.back() : track.X_WA.front(), {}, 0.0};
  }
  const std::size_t i = std::min(static_cast<std::size_t>(place), track.X_WA.size() - 2);
  const double u = place - static_cast<double>(i);
  const Pose& a = track.X_WA[i];
  const Pose& b = track.X_WA[i + 1];
  const Vec2 way = b.p - a.p;
  const double turn = wrap_angle(b.yaw - a.yaw);
  return {{a.p + u * way, a.yaw + u * turn}, (1.0 / track.step) * way, turn / track.step};
}

class Pair {
 public:
  Pair(const AtlasEgo& ego, std::size_t actor, const Track& track, const Boxes& boxes) noexcept
      : ego_(&ego),
        actor_(&ego.scene().actors[actor]),
        track_(&track),
        boxes_(&boxes),
        start_(ego.scene().time),
        reach_(reach_of(ego.scene().ego_footprint) + reach_of(actor_->footprint)),
        spreads_(ego.scene().grip_sd > 0.0 || actor_->position_sd > 0.0 ||
                 actor_->velocity_sd > 0.0) {}

  [[nodiscard]] Meeting search(double of_interest, double until) noexcept;

 private:
  struct Look {
    double time = 0.0;
    Gap gap;
    double closing = 0.0;  // along the gap, turning included [m/s]
  };

  // Only of boxes do a few directions tell for sure.
  [[nodiscard]] bool either_is_round() const noexcept {
    return actor_->footprint.shape == Shape::ellipse ||
           ego_->scene().ego_footprint.shape == Shape::ellipse;
  }
  [[nodiscard]] double distance_at(double time) const noexcept {
    return separation(ego_->scene().ego_footprint, ego_->at(time).X_WB, actor_->footprint,
                      pose_at(*track_, start_ + time))
        .distance;
  }
  [[nodiscard]] double gap_at(double time) const noexcept;
  [[nodiscard]] double passed_over(double time) const noexcept;
  [[nodiscard]] Look look(double time) const noexcept;
  [[nodiscard]] Spread spread(double time, Vec2 n_W) const noexcept;
  [[nodiscard]] double last_look() const noexcept;
  [[nodiscard]] double first_touch(double apart, double touching) const noexcept;
  [[nodiscard]] double score(const Look& now) const noexcept;
  bool keep(const Look& now, double size) noexcept;
  void refine(double from, double to) noexcept;

  const AtlasEgo* ego_;
  const world::Actor* actor_;
  const Track* track_;
  const Boxes* boxes_;
  double start_;
  double reach_ = 0.0;  // of both bodies together from their origins [m]
  bool spreads_;
  double best_score_ = std::numeric_limits<double>::infinity();
  Meeting found_;
};

// Positive while they are apart: of boxes never more than the distance, of others exact.
double Pair::gap_at(double time) const noexcept {
  const Gap gap = gap_between(body_at(ego_->scene().ego_footprint, ego_->at(time).X_WB),
                              body_at(actor_->footprint, on_track(*track_, start_ + time).X_WA));
  return gap.size <= 0.0 && either_is_round() ? std::max(gap.size, distance_at(time)) : gap.size;
}

Spread Pair::spread(double time, Vec2 n_W) const noexcept {
  const double moved = actor_->velocity_sd * time;
  Spread spread{0.0, actor_->position_sd * actor_->position_sd + moved * moved};
  const double grip_sd = ego_->scene().grip_sd / ego_->scene().grip;
  if (grip_sd > 0.0) {
    const Spread grip = of_halves(dot(n_W, ego_->sway(time, 1.0 - grip_sd).p),
                                  dot(n_W, ego_->sway(time, 1.0 + grip_sd).p));
    // The ego farther along n_W leaves a smaller gap.
    spread.mean = -grip.mean;
    spread.variance += std::max(0.0, grip.variance);
  }
  return spread;
}

Pair::Look Pair::look(double time) const noexcept {
  const Instant ego = ego_->at(time);
  const OnTrack other = on_track(*track_, start_ + time);
  Look now{.time = time};
  now.gap = gap_between(body_at(ego_->scene().ego_footprint, ego.X_WB),
                        body_at(actor_->footprint, other.X_WA));
  const double turning = reach_ * (std::abs(ego.yaw_rate) + std::abs(other.yaw_rate));
  now.closing = dot(now.gap.n, ego.v_W - other.v_W) + turning;
  return now;
}

// The end of the pieces of time from `time` on in which they are too far from each other to matter.
double Pair::passed_over(double time) const noexcept {
  std::size_t i = piece_at(time);
  for (; i < Boxes::count; ++i) {
    const double until = static_cast<double>(i + 1) * Boxes::piece;
    const double sd =
        spreads_ ? actor_->position_sd + actor_->velocity_sd * until + ego_->most_sway() : 0.0;
    const double matters = std::max(found_.contact ? 0.0 : found_.clearance, sure_sd * sd);
    if (distance_between(ego_->boxes(), *boxes_, i) - reach_ < matters) {
      return i == piece_at(time) ? time : static_cast<double>(i) * Boxes::piece;
    }
  }
  return std::numeric_limits<double>::infinity();
}

double Pair::last_look() const noexcept {
  const double track_end = end_time(*track_) - start_;
  const auto& poses = track_->X_WA;
  const bool moves =
      poses.size() > 1 && norm(poses.back().p - poses[poses.size() - 2].p) > still * track_->step;
  if (ego_->path().rests) {
    return moves ? track_end : std::max(ego_->path().end, track_end);
  }
  return moves ? std::min(ego_->last_look(), track_end) : ego_->last_look();
}

// Between a time apart and one where they touch: the false position, halved where it sticks.
double Pair::first_touch(double apart, double touching_time) const noexcept {
  double high = gap_at(apart);
  double low = gap_at(touching_time);
  for (int i = 0; i < 24 && touching_time - apart > 1e-6 && high > 1e-5; ++i) {
    const double share = high - low > 0.0 && i % 3 != 2 ? high / (high - low) : 0.5;
    const double middle = apart + std::clamp(share, 0.02, 0.98) * (touching_time - apart);
    const double gap = gap_at(middle);
    (gap > 0.0 ? apart : touching_time) = middle;
    (gap > 0.0 ? high : low) = gap;
  }
  return apart;
}

// How many standard deviations of the gap are between them; without any, the gap itself.
double Pair::score(const Look& now) const noexcept {
  if (!spreads_) {
    return now.gap.size;
  }
  constexpr double least_sd = 1e-3;
  const double most_sd =
      actor_->position_sd + actor_->velocity_sd * now.time + ego_->most_sway() + least_sd;
  if (now.gap.size > (sure_sd + 1.0) * most_sd) {
    return now.gap.size / most_sd;  // so far apart that how far does not matter
  }
  const Spread here = spread(now.time, now.gap.n);
  constexpr double least_variance = least_sd * least_sd;
  return (now.gap.size + here.mean) / std::sqrt(std::max(here.variance, least_variance));
}

// Keeps the look at which contact is likeliest.
bool Pair::keep(const Look& now, double size) noexcept {
  found_.clearance = std::min(found_.clearance, std::max(0.0, size));
  const double now_score = score(now);
  if (!(now_score < best_score_)) {
    return false;
  }
  best_score_ = now_score;
  found_.nearest = now.time;
  found_.gap = now.gap.size;
  found_.n_W = now.gap.n;
  return true;
}

// Looks more closely between the looks on either side of the likeliest one.
void Pair::refine(double from, double to) noexcept {
  for (int i = 0; i < 5; ++i) {
    const double middle = found_.nearest;
    const bool first = middle - from > to - middle;
    const Look now = look(first ? 0.5 * (from + middle) : 0.5 * (middle + to));
    if (keep(now, now.gap.size)) {
      (first ? to : from) = middle;
    } else {
      (first ? from : to) = now.time;
    }
  }
}

Meeting Pair::search(double of_interest, double until) noexcept {
  found_.clearance = of_interest;
  const double last = std::min(until, last_look());
  double time = passed_over(std::max(0.0, track_->start - start_));
  double before = time;
  double low = time;  // the looks before and after the likeliest one
  double high = time;
  bool looks_on = true;
  while (time <= last) {
    const Look now = look(time);
    double size = now.gap.size;
    if (size <= 0.0 && either_is_round()) {
      size = std::max(size, distance_at(time));
    }
    if (!found_.contact && size <= 0.0) {
      found_.contact = before < time ? first_touch(before, time) : time;
    }
    high = looks_on ? time : high;
    looks_on = keep(now, size);
    low = looks_on ? before : low;
    if (found_.contact && (!spreads_ || now.closing < 0.0)) {
      break;  // all is known, or they are on the way out
    }
    const double room = std::max(0.0, size);
    const double closing = now.closing + jump;
    const double safe =
        (std::sqrt(closing * closing + 2.0 * most_change * room) - closing) / most_change;
    const double next = time + std::max(safe, found_.contact ? 3.0 * least_step : least_step);
    const bool anew = piece_at(next) != piece_at(time);
    const double far = anew ? passed_over(std::min(next, last)) : next;
    before = far > next ? far : time;
    time = time < last ? std::max(std::min(last, next), far) : last + 1.0;
  }
  if (best_score_ < std::numeric_limits<double>::infinity() && (!found_.contact || spreads_)) {
    refine(low, std::max(high, found_.nearest));
  }
  found_.probability = spreads_ ? normal_below(-best_score_) : found_.contact ? 1.0 : 0.0;
  if (found_.contact) {
    found_.clearance = 0.0;
  }
  return found_;
}

}  // namespace

AtlasEgo::AtlasEgo(const manoeuvre::AtlasPath& path, const world::Scene& scene) noexcept
    : path_(&path),
      scene_(&scene),
      start_(to_lane(scene.road, scene.ego.X_WB)),
      along_{std::cos(scene.road.X_WL.yaw), std::sin(scene.road.X_WL.yaw)} {
  last_look_ = path.rests   ? std::numeric_limits<double>::infinity()
               : path.ended ? path.end + goes_on_for
                            : path.end;
  find_boxes();
  const double share = scene.grip_sd / (scene.grip * manoeuvre::sway_factor);
  for (const std::size_t c : {0U, 3U}) {
    for (std::size_t i = 0; share > 0.0 && i < manoeuvre::sway_samples; ++i) {
      const auto x = static_cast<double>(path.sway[c][i]);
      const auto y = static_cast<double>(path.sway[c + 1][i]);
      most_sway_ = std::max(most_sway_, share * std::sqrt(x * x + y * y));
    }
  }
}

void AtlasEgo::find_boxes() noexcept {
  constexpr double bulge = 0.1;  // between samples, beyond what they span [m]
  begin(boxes_);
  const double step = path_->span / static_cast<double>(manoeuvre::atlas_samples - 1);
  Vec2 p_W = at(0.0).X_WB.p;
  double time = 0.0;
  constexpr std::size_t stride = 3;
  for (std::size_t i = stride; i < manoeuvre::atlas_samples && time < path_->end; i += stride) {
    const double next = std::min(path_->end, static_cast<double>(i) * step);
    const Vec2 q_W = place(next, static_cast<double>(path_->channel[0][i]),
                           static_cast<double>(path_->channel[1][i]), i);
    const Vec2 way = q_W - p_W;
    cover(boxes_, time, next, p_W, q_W, bulge + 0.1 * std::sqrt(dot(way, way)));
    p_W = q_W;
    time = next;
  }
  // On along the lane, or at rest.
  const double end = std::isfinite(last_look_) ? std::max(last_look_, time) : large;
  for (int i = 1; i <= 5 && !path_->rests; ++i) {
    const double next = path_->end + (end - path_->end) * i / 5.0;
    const Vec2 q_W = at(next).X_WB.p;
    cover(boxes_, time, next, p_W, q_W, bulge);
    p_W = q_W;
    time = next;
  }
  cover(boxes_, time, large, p_W, p_W, bulge);
}

// Where sample `i` is, or at the end of what comes before it.
Vec2 AtlasEgo::place(double time, double x, double y, std::size_t i) const noexcept {
  const double step = path_->span / static_cast<double>(manoeuvre::atlas_samples - 1);
  if (scene_->road.curvature != 0.0 || time < static_cast<double>(i) * step) {
    return at(time).X_WB.p;
  }
  return scene_->road.X_WL.p + (start_.s + x) * along_ + (start_.d + y) * left_of(along_);
}

world::LanePose AtlasEgo::in_lane(double time) const noexcept {
  const AtlasInstant now = manoeuvre::at(*path_, time);
  return {start_.s + now.x, start_.d + now.y, now.heading};
}

Instant AtlasEgo::at(double time) const noexcept {
  const AtlasInstant now = manoeuvre::at(*path_, time);
  const world::Road& road = scene_->road;
  const double s = start_.s + now.x;
  const double d = start_.d + now.y;
  if (road.curvature == 0.0) {
    const Vec2 across = left_of(along_);
    return {{road.X_WL.p + s * along_ + d * across, wrap_angle(road.X_WL.yaw + now.heading)},
            now.x_rate * along_ + now.y_rate * across,
            now.turn_rate};
  }
  const Pose X_WB = from_lane(road, {s, d, now.heading});
  const double lane_yaw = X_WB.yaw - now.heading;
  return {X_WB, rotated({now.x_rate * (1.0 - road.curvature * d), now.y_rate}, lane_yaw),
          now.turn_rate + road.curvature * now.x_rate};
}

Pose AtlasEgo::sway(double time, double grip_factor) const noexcept {
  const manoeuvre::Sway sway = manoeuvre::sway_at(*path_, time, grip_factor);
  const double lane_yaw = scene_->road.X_WL.yaw + scene_->road.curvature * in_lane(time).s;
  return {rotated({sway.x, sway.y}, lane_yaw), sway.heading};
}

Boxes boxes_of(const Track& track, double start) noexcept {
  constexpr double look = 0.2;   // [s]
  constexpr double bulge = 0.1;  // [m]
  Boxes boxes;
  begin(boxes);
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::floor(look / track.step)));
  const std::size_t last = track.X_WA.size() - 1;
  Vec2 p_W = track.X_WA.front().p;
  double time = 0.0;
  cover(boxes, time, track.start - start, p_W, p_W, bulge);
  for (std::size_t i = std::min(stride, last); time < large; i = std::min(i + stride, last)) {
    const Vec2 q_W = track.X_WA[i].p;
    const double next = track.start - start + static_cast<double>(i) * track.step;
    const Vec2 way = q_W - p_W;
    const double turns = 0.25 * std::sqrt(dot(way, way));  // it may leave the straight line by
    if (next >= 0.0) {
      cover(boxes, std::max(0.0, time), next, p_W, q_W, bulge + turns);
    }
    p_W = q_W;
    time = next;
    if (i == last) {
      cover(boxes, std::max(0.0, time), large, p_W, p_W, bulge);
      break;
    }
  }
  return boxes;
}

Meeting meeting(const AtlasEgo& ego, std::size_t actor, const Track& track, const Boxes& boxes,
                double of_interest, double until) noexcept {
  return Pair(ego, actor, track, boxes).search(of_interest, until);
}

namespace {

// How far the ego reaches beyond its offset to one side.
double reach_aside(const Footprint& body, double heading, double sign) noexcept {
  const double c = std::cos(heading);
  const double n = std::sin(heading);
  const Vec2 half = half_axes(body);
  const Vec2 across{half.x * n, half.y * c};
  const double most = body.shape == Shape::ellipse ? std::sqrt(dot(across, across))
                                                   : std::abs(across.x) + std::abs(across.y);
  return most + sign * body.centre_x * n;
}

// The room between the ego and an edge.
double room_at(const AtlasEgo& ego, Side side, double time) noexcept {
  const world::Road& road = ego.scene().road;
  if (road.curvature != 0.0) {
    return room(road, side, ego.scene().ego_footprint, ego.at(time).X_WB);
  }
  const world::LanePose pose = ego.in_lane(time);
  const double sign = side == Side::left ? 1.0 : -1.0;
  const double edge = side == Side::left ? road.left_edge : -road.right_edge;
  return edge - sign * pose.d - reach_aside(ego.scene().ego_footprint, pose.heading, sign);
}

// The least room that there can be, by the farthest sample and the body's reach.
double least_room(const AtlasEgo& ego, Side side) noexcept {
  const world::Road& road = ego.scene().road;
  const double sign = side == Side::left ? 1.0 : -1.0;
  const double edge = side == Side::left ? road.left_edge : -road.right_edge;
  double most = 0.0;
  for (const float y : ego.path().channel[1]) {
    most = std::max(most, sign * static_cast<double>(y));
  }
  return edge - sign * ego.path().start_d - most - reach_of(ego.scene().ego_footprint);
}

}  // namespace

Meeting edge_meeting(const AtlasEgo& ego, Side side, double of_interest) noexcept {
  Meeting found{.clearance = of_interest};
  if (least_room(ego, side) > std::max(of_interest, sure_sd * ego.most_sway())) {
    return found;
  }
  const double sign = side == Side::left ? 1.0 : -1.0;
  const double end = ego.path().rests ? ego.path().end : ego.last_look();
  const double grip_sd = ego.scene().grip_sd / ego.scene().grip;
  constexpr int num_looks = 40;
  double before = 0.0;
  for (int i = 0; i <= num_looks; ++i) {
    const double time = end * i / num_looks;
    const double gap = room_at(ego, side, time);
    if (gap <= 0.0 && !found.contact) {
      double crossing = time;
      for (int k = 0; k < 14 && i > 0; ++k) {
        const double middle = 0.5 * (before + crossing);
        (room_at(ego, side, middle) > 0.0 ? before : crossing) = middle;
      }
      found.contact = crossing;
    }
    Spread sway;
    if (grip_sd > 0.0) {
      sway = of_halves(sign * manoeuvre::sway_at(ego.path(), time, 1.0 - grip_sd).y,
                       sign * manoeuvre::sway_at(ego.path(), time, 1.0 + grip_sd).y);
    }
    const double probability = sway.variance > 0.0
                                   ? normal_below(-(gap - sway.mean) / std::sqrt(sway.variance))
                                   : (gap <= 0.0 ? 1.0 : 0.0);
    if (probability > found.probability) {
      found.probability = probability;
      found.nearest = time;
      found.gap = gap;
    }
    found.clearance = std::max(0.0, std::min(found.clearance, gap));
    before = time;
  }
  return found;
}

}  // namespace saca::outcome
