#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/intention_scoring/labels.h"
#include "saca/lab/intention_scoring/motion_fit.h"
#include "saca/lab/recordings/recorded_set.h"

namespace saca::intention_study {

/// What is measured of one site's motions.
struct SiteMotion {
  std::string site;  ///< "all": of all sites together
  intention_scoring::MotionFit fit;
};

/// Measures how people really brake and change lanes, in one recorded set after the other.
class MotionStudy {
 public:
  /// Tracks shorter than `intention_scoring::fewest_frames` tell too little and are left out.
  void add(const recordings::RecordedSet& set);

  /// Of each site in the alphabet's order; none where nothing was added.
  [[nodiscard]] std::vector<SiteMotion> sites() const;

 private:
  std::map<std::string, std::vector<intention_scoring::TrueMotion>> motions_;  ///< by site
};

/// The document of `saca intent motion --json`: schema saca.intent_motion/1.
[[nodiscard]] nlohmann::json motion_json(const std::vector<SiteMotion>& motions);

/// The same for people.
[[nodiscard]] std::string motion_text(const std::vector<SiteMotion>& motions);

}  // namespace saca::intention_study
