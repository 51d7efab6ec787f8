#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "saca/base/core/pose.h"
#include "saca/lab/encounter/verdict_log.h"

namespace saca::encounter {

/// Where one road user goes under one hypothesis.
struct HypotheticalPath {
  std::string actor;       ///< its name
  std::vector<Pose> X_WA;  ///< every Hypotheses::step from the judged scene on, at least one;
                           ///< after the last it stands
};

/// One way in which the others together may move on.
struct HypotheticalMotion {
  double probability = 1.0;
  std::vector<HypotheticalPath> paths;  ///< of the same road users in each
};

/// The joint motions that a verdict held every plan against, thinned for a picture.
struct Hypotheses {
  static constexpr double step = 0.25;            ///< between the poses of a path [s]
  static constexpr double horizon = 4.0;          ///< of a path [s]
  static constexpr double resolution = 0.01;      ///< of a place [m]
  static constexpr std::size_t most_actors = 12;  ///< those nearest to the ego

  double begun = 0.0;                 ///< when a plan was begun by that verdict [s]
  double time = 0.0;                  ///< of the judged scene [s]
  std::vector<std::string> reacting;  ///< those behind: they react to the ego, under each plan
                                      ///< otherwise, so they have no paths
  std::vector<HypotheticalMotion> motions;  ///< their probabilities sum to 1; those that are the
                                            ///< same to the resolution are one
};

/// Works out again what the verdict of this scene was made by: the draws of the forecaster
/// (arbitration::draws_of), or where the reflex plane read the atlas, that the others go on as they
/// do.
[[nodiscard]] Hypotheses hypotheses_of(const JudgedScene& judged);

}  // namespace saca::encounter
