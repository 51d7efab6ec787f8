#include "saca/thinking/intent/side_moves.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <span>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/quintic.h"

namespace saca::intent {
namespace {

constexpr int num_times = 9;
constexpr int num_shares = 24;
constexpr int num_groups = 8;

/// When each of twelve equally weighty parts of a fading past was, in shares of the time after
/// which 1/e of it is left.
std::array<double, 12> parts_of_the_past() {
  std::array<double, 12> parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i] = std::log1p(-(static_cast<double>(i) + 0.5) / static_cast<double>(parts.size()));
  }
  return parts;
}

/// The move's acceleration in shares of size and time, as it is perceived: its mean over the past,
/// fading with `lag`, in shares of the time.
double perceived_acceleration_share(double x, double lag) {
  static const auto parts = parts_of_the_past();
  double sum = 0.0;
  for (const double part : parts) {
    sum += quintic_curvature(x + lag * part);
  }
  return sum / static_cast<double>(parts.size());
}

struct Candidate {
  SideMove move;
  double left = 0.0;  // of the way, in the direction of the measured speed [m]
};

/// Of this time and progress; its probability is the logarithm of a weight.
Candidate candidate(const MeasuredSideMove& measured, const SideMoveLaw& law, double time,
                    double share) {
  constexpr double least_sd = 0.05;  // [m/s]: nobody's speed is smoother
  const double speed_sd = std::max(least_sd, measured.speed_sd);
  struct Equation {
    double per_size;
    double measured;
  };
  const std::array<Equation, 2> equations{
      {{quintic_slope(share) / (time * speed_sd), measured.speed / speed_sd},
       {perceived_acceleration_share(share, law.acceleration_lag / time) /
            (time * time * law.acceleration_sd),
        measured.acceleration / law.acceleration_sd}}};
  double precision = 1.0 / (law.size * law.size);
  double sum = 0.0;
  double unexplained = 0.0;
  for (const Equation& one : equations) {
    precision += one.per_size * one.per_size;
    sum += one.per_size * one.measured;
    unexplained += one.measured * one.measured;
  }
  const double size = sum / precision;
  const double rest = 1.0 - quintic(share);
  return {{.probability = -0.5 * (unexplained - sum * size + std::log(precision)),
           .size = size,
           .time = time,
           .share = share,
           .left_sd = rest / std::sqrt(precision)},
          (measured.speed < 0.0 ? -1.0 : 1.0) * size * rest};
}

double weight_of(std::span<const Candidate> some) {
  double sum = 0.0;
  for (const Candidate& one : some) {
    sum += one.move.probability;
  }
  return sum;
}

/// The middle one by weight, with the spread of them all about it.
SideMove standing_for(std::span<const Candidate> some, double weight) {
  std::size_t middle = 0;
  for (double until = some[0].move.probability; until < 0.5 * weight && middle + 1 < some.size();) {
    until += some[++middle].move.probability;
  }
  SideMove move = some[middle].move;
  double variance = 0.0;
  for (const Candidate& one : some) {
    const double off = one.left - some[middle].left;
    variance += one.move.probability * (off * off + one.move.left_sd * one.move.left_sd);
  }
  move.left_sd = std::sqrt(variance / weight);
  return move;
}

/// Those that end alike together, in groups of about the same weight; one stands for each.
std::vector<SideMove> grouped(std::vector<Candidate> all) {
  std::sort(all.begin(), all.end(),
            [](const Candidate& a, const Candidate& b) { return a.left < b.left; });
  const double sum = weight_of(all);
  std::vector<SideMove> moves;
  std::size_t first = 0;
  double until = 0.0;  // weight of the groups and of this one so far
  for (std::size_t end = 1; end <= all.size(); ++end) {
    until += all[end - 1].move.probability;
    const double wanted = sum * static_cast<double>(moves.size() + 1) / num_groups;
    if (until < wanted && end < all.size()) {
      continue;
    }
    const std::span<const Candidate> group(all.begin() + static_cast<std::ptrdiff_t>(first),
                                           end - first);
    if (const double weight = weight_of(group); weight > 0.0) {
      moves.push_back(standing_for(group, weight));
      moves.back().probability = weight / sum;
    }
    first = end;
  }
  return moves;
}

}  // namespace

MeasuredSideMove measured_side_move(const Line& line, const world::Actor& actor) {
  const double of_the_bend = line.road.curvature * line.speed * line.speed;
  return {.speed = line.lateral,
          .speed_sd = actor.velocity_sd,
          .acceleration = rotated(actor.a_W, -line.road.X_WL.yaw).y - of_the_bend};
}

double SideMove::way(double after) const {
  return size * (quintic(share + after / time) - quintic(share));
}

double SideMove::speed(double after) const {
  return size / time * quintic_slope(share + after / time);
}

double SideMove::way_sd(double after) const {
  const double begun = quintic(share);
  return begun < 1.0 ? left_sd * (quintic(share + after / time) - begun) / (1.0 - begun) : left_sd;
}

std::vector<SideMove> side_moves(const MeasuredSideMove& measured, const SideMoveLaw& law) {
  expects(law.time > 0.0 && law.time_log_sd > 0.0 && law.size > 0.0 && law.acceleration_sd > 0.0 &&
              law.acceleration_lag > 0.0,
          "a law's numbers are in their ranges");
  expects(measured.speed_sd >= 0.0, "speed_sd >= 0");
  std::vector<Candidate> all;
  all.reserve(std::size_t{num_times} * num_shares);
  for (int i = 0; i < num_times; ++i) {
    const double quantile = boost::math::quantile(boost::math::normal(), (i + 0.5) / num_times);
    const double time = law.time * std::exp(law.time_log_sd * quantile);
    for (int k = 0; k < num_shares; ++k) {
      all.push_back(candidate(measured, law, time, (k + 0.5) / num_shares));
    }
  }
  const double likeliest =
      std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.move.probability < b.move.probability;
      })->move.probability;
  for (Candidate& one : all) {
    one.move.probability = std::exp(one.move.probability - likeliest);
  }
  return grouped(std::move(all));
}

}  // namespace saca::intent
