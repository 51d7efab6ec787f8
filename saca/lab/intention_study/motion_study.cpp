#include "saca/lab/intention_study/motion_study.h"

#include <fmt/core.h>

#include <array>
#include <string_view>
#include <utility>

#include "saca/lab/intention_scoring/examples.h"

namespace saca::intention_study {
namespace {

using intention_scoring::LogNormal;
using intention_scoring::MotionFit;

constexpr double scaled_to = 3.5;  // [m]: the width of the lanes that lane changes are scaled to

/// What is measured of positive quantities, in words, and its name in JSON.
struct MeasuredQuantity {
  std::string_view words;
  const char* key;
  LogNormal MotionFit::*fit;
};
constexpr std::array<MeasuredQuantity, 4> measured{
    {{"deceleration of a braking [m/s2]", "braking_mps2", &MotionFit::braking},
     {"its rise [s]", "rise_s", &MotionFit::rise},
     {"deceleration 1 s on over that of now", "held", &MotionFit::held},
     {"a lane's change [s]", "lane_change_s", &MotionFit::lane_change}}};

}  // namespace

void MotionStudy::add(const recordings::RecordedSet& set) {
  for (const recordings::Recording& recording : set.recordings) {
    for (const recordings::RecordedVehicle& vehicle : recording.vehicles) {
      if (vehicle.samples.size() >= intention_scoring::fewest_frames) {
        intention_scoring::TrueMotion motion =
            intention_scoring::true_motion(vehicle, recording.step);
        motions_["all"].push_back(motion);
        motions_[recording.site].push_back(std::move(motion));
      }
    }
  }
}

std::vector<SiteMotion> MotionStudy::sites() const {
  std::vector<SiteMotion> sites;
  for (const auto& [site, some] : motions_) {
    sites.push_back({.site = site, .fit = intention_scoring::motion_fit(some, scaled_to)});
  }
  return sites;
}

nlohmann::json motion_json(const std::vector<SiteMotion>& motions) {
  nlohmann::json document = {{"schema", "saca.intent_motion/1"}};
  for (const SiteMotion& motion : motions) {
    nlohmann::json site = {{"acceleration_sd_mps2", motion.fit.acceleration.sd},
                           {"acceleration_time_s", motion.fit.acceleration.time}};
    for (const MeasuredQuantity& each : measured) {
      const LogNormal& one = motion.fit.*each.fit;
      site[each.key] = {{"num", one.num}, {"median", one.median}, {"log_sd", one.log_sd}};
    }
    document["sites"][motion.site] = std::move(site);
  }
  return document;
}

std::string motion_text(const std::vector<SiteMotion>& motions) {
  std::string text;
  for (const SiteMotion& motion : motions) {
    text += fmt::format("{}: maintaining, acceleration wavers by {:.2f} m/s2 over {:.1f} s\n",
                        motion.site, motion.fit.acceleration.sd, motion.fit.acceleration.time);
    for (const MeasuredQuantity& each : measured) {
      const LogNormal& one = motion.fit.*each.fit;
      text += fmt::format("  {:38} median {:5.2f}, sd of the logarithm {:.2f} ({} measured)\n",
                          each.words, one.median, one.log_sd, one.num);
    }
  }
  return text;
}

}  // namespace saca::intention_study
