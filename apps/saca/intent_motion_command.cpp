#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/saca/commands.h"
#include "apps/saca/intent_commands.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/lab/recordings/set_file.h"
#include "saca/lab/training/examples.h"
#include "saca/lab/training/motion_fit.h"

namespace saca::app {
namespace {

using training::LogNormal;
using training::MotionFit;

constexpr double scaled_to = 3.5;  // [m]: the width of the lanes that lane changes are scaled to

struct MotionOptions {
  std::vector<std::string> sets;
  bool as_json = false;
};

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

nlohmann::json fit_json(const MotionFit& fit) {
  nlohmann::json document = {{"acceleration_sd_mps2", fit.acceleration.sd},
                             {"acceleration_time_s", fit.acceleration.time}};
  for (const MeasuredQuantity& each : measured) {
    const LogNormal& one = fit.*each.fit;
    document[each.key] = {{"num", one.num}, {"median", one.median}, {"log_sd", one.log_sd}};
  }
  return document;
}

void tell_fit(const std::string& site, const MotionFit& fit) {
  app::print("{}: maintaining, acceleration wavers by {:.2f} m/s2 over {:.1f} s\n", site,
             fit.acceleration.sd, fit.acceleration.time);
  for (const MeasuredQuantity& each : measured) {
    const LogNormal& one = fit.*each.fit;
    app::print("  {:38} median {:5.2f}, sd of the logarithm {:.2f} ({} measured)\n", each.words,
               one.median, one.log_sd, one.num);
  }
}

int fit_motion(const MotionOptions& options) {
  std::map<std::string, std::vector<training::TrueMotion>> motions;
  for (const std::string& file : options.sets) {
    const auto set = recordings::read_set(file);
    if (!set.has_value()) {
      return refused(set.error());
    }
    for (const recordings::Recording& recording : set.value().recordings) {
      for (const recordings::RecordedVehicle& vehicle : recording.vehicles) {
        if (vehicle.samples.size() >= training::fewest_frames) {
          training::TrueMotion motion = training::true_motion(vehicle, recording.step);
          motions["all"].push_back(motion);
          motions[recording.site].push_back(std::move(motion));
        }
      }
    }
  }
  nlohmann::json document = {{"schema", "saca.intent_motion/1"}};
  for (const auto& [site, some] : motions) {
    const MotionFit fit = training::motion_fit(some, scaled_to);
    if (options.as_json) {
      document["sites"][site] = fit_json(fit);
    } else {
      tell_fit(site, fit);
    }
  }
  if (options.as_json) {
    app::print_json(document);
  }
  return success;
}

}  // namespace

void add_intent_motion(CLI::App& intent, int& exit_code) {
  CLI::App* const command =
      intent.add_subcommand("motion", "Measure how people really brake and change lanes");
  const auto options = std::make_shared<MotionOptions>();
  command->add_option("sets", options->sets, "HDF5 files of `saca traffic pack`")->required();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options, &exit_code] { exit_code = fit_motion(*options); });
}

}  // namespace saca::app
