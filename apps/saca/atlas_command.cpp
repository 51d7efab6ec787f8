#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/saca/atlas_making.h"
#include "apps/saca/commands.h"
#include "apps/saca/inputs.h"
#include "apps/saca/json_output.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/base/core/parallel.h"
#include "saca/lab/eval/atlas_check.h"
#include "saca/lab/families/splits.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/onboard/atlas/atlas_file.h"
#include "saca/onboard/reflex/vehicle_package.h"

namespace saca::app {
namespace {

namespace fs = std::filesystem;
using atlas::AtlasAxes;
using atlas::AtlasKind;
using nlohmann::json;

struct AtlasOptions {
  std::string car = "compact_rwd_ev";
  std::string file;
  int threads = usual_threads();
  int scenes = 1'000;
  std::optional<std::uint64_t> seed;  // of the samples; none: the calibration split's
  bool as_json = false;
};

/// The file that was named, else the one that `saca run` looks for.
fs::path file_of(const AtlasOptions& options, const Inputs& inputs) {
  return options.file.empty() ? atlas_place(inputs.places, inputs.car_name)
                              : fs::path(options.file);
}

int build(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const fs::path output = file_of(options, inputs.value());
  if (atlas::read_atlas(output, inputs.value().car).has_value()) {
    app::print("{} is there and right for this car\n", output.string());
    return success;
  }
  if (const auto problem = long_work::why_outputs_unwritable({output})) {
    return refused(*problem);
  }
  const auto atlas = make_atlas(inputs.value(), output, options.threads);
  if (!atlas.has_value()) {
    return refused(atlas.error());
  }
  if (!atlas.value()) {
    return was_interrupted;
  }
  std::error_code unknown;
  app::print("{}: {} points, {:.1f} MB\n", output.string(), atlas.value()->nodes().size(),
             1e-6 * static_cast<double>(fs::file_size(output, unknown)));
  return success;
}

/// One file for a vehicle: the car's numbers, the harm model and the atlas.
int package(const AtlasOptions& options, const std::string& package_file) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const std::string& name = inputs.value().car_name;
  if (name.size() > reflex::longest_package_name) {
    return refused(Error{Error::Code::out_of_range,
                         fmt::format("{}: want a car's name of at most {} bytes, got {}", name,
                                     reflex::longest_package_name, name.size())});
  }
  const fs::path file = file_of(options, inputs.value());
  const auto atlas = read_file(file, many_bytes);
  const auto right = atlas.has_value()
                         ? atlas::parse_atlas(atlas.value(), file.string(), inputs.value().car)
                         : atlas.error();
  if (!right.has_value()) {
    Error error = right.error();
    error.message += " (`saca atlas build --car " + options.car + "` makes it)";
    return refused(error);
  }
  const fs::path output =
      package_file.empty() ? fs::path(name + ".vehicle") : fs::path(package_file);
  const std::string bytes =
      reflex::vehicle_package_bytes(name, inputs.value().car, inputs.value().harm, atlas.value());
  if (const auto problem = long_work::write_output(output, bytes)) {
    return refused(*problem);
  }
  app::print("{}: {}, {:.1f} MB\n", output.string(), name,
             1e-6 * static_cast<double>(bytes.size()));
  return success;
}

json axis_of(const AtlasAxes::Axis& axis) {
  json values = json::array();
  for (const double value : axis) {
    values.push_back(value);
  }
  return values;
}

json told(const atlas::AtlasInfo& info, const std::optional<std::string>& problem) {
  json kinds = json::array();
  for (std::size_t kind = 0; kind < atlas::num_atlas_kinds; ++kind) {
    const AtlasAxes& axes = info.grid[kind];
    const bool stops = static_cast<AtlasKind>(kind) == AtlasKind::stop;
    kinds.push_back({{"kind", name(static_cast<AtlasKind>(kind))},
                     {"points", axes.num_nodes()},
                     {"speed_mps", axis_of(axes.speeds)},
                     {"grip", axis_of(axes.grips)},
                     {"way_m", axis_of(axes.ways)},
                     {stops ? "strength" : "target_share", axis_of(axes.shares)}});
  }
  return {{"schema", "saca.atlas_info/1"},
          {"version", atlas::atlas_version},
          {"car_hash", fmt::format("{:016x}", info.car)},
          {"bytes", info.bytes},
          {"points", num_nodes(info.grid)},
          {"usable", !problem.has_value()},
          {"problem", problem ? json(*problem) : json()},
          {"kinds", kinds}};
}

int tell(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const fs::path file = file_of(options, inputs.value());
  const auto info = atlas::read_atlas_info(file);
  if (!info.has_value()) {
    return refused(info.error());
  }
  const auto atlas = atlas::read_atlas(file, inputs.value().car);
  const auto problem = atlas.has_value() ? std::nullopt : std::optional(atlas.error().message);
  const json about = told(info.value(), problem);
  if (options.as_json) {
    app::print_json(about);
  } else {
    app::print("{}: whole, version {}, {} points, {:.1f} MB, car {}\n", file.string(),
               atlas::atlas_version, num_nodes(info.value().grid),
               1e-6 * static_cast<double>(info.value().bytes),
               about["car_hash"].get<std::string>());
    for (const json& kind : about["kinds"]) {
      app::print("  {:15} {:5} points: {:.4g} to {:.4g} m/s, grip {:.3g} to {:.3g}\n",
                 kind["kind"].get<std::string>(), kind["points"].get<int>(),
                 kind["speed_mps"].front().get<double>(), kind["speed_mps"].back().get<double>(),
                 kind["grip"].front().get<double>(), kind["grip"].back().get<double>());
    }
    app::print("{}\n",
               problem ? *problem
                       : "of " + inputs.value().car_name + " as this program drives it: usable");
  }
  return problem ? bad_input : success;
}

void print_figures(const eval::AtlasFigures& figures, const json& all, bool as_json) {
  if (as_json) {
    app::print_json(all);
    return;
  }
  const auto percent = [](const Proportion& share) {
    return fmt::format("{:.2f} % ({:.2f} to {:.2f})", 100.0 * share.share, 100.0 * share.low,
                       100.0 * share.high);
  };
  app::print("{} scenes, {} plans that physics does not refuse\n", figures.scenes, figures.plans);
  app::print("  within the atlas' bounds   {}\n", percent(figures.covered));
  app::print("  agree on contact           {}\n", percent(figures.agreement));
  app::print("  on with whom               {}\n", percent(figures.partner));
  app::print("  on the ego's face          {}\n", percent(figures.face));
  app::print("  impact speed off by        {:.3f} m/s p50, {:.3f} p95, {:.2f} at most\n",
             figures.speed_p50, figures.speed_p95, figures.speed_max);
  app::print("  clearance off by           {:.2f} m p95 (below 5 m)\n", figures.clearance_p95);
  app::print("  regret of choosing by it   {:.4f} mean, {:.4f} p95; none in {}\n",
             figures.regret_mean, figures.regret_p95, percent(figures.same_choice));
  app::print(
      "    where nothing is struck twice: {:.4f} mean in {} scenes, {:.1f} % of all regret\n",
      figures.lone.mean, figures.lone.scenes, 100.0 * figures.lone.share);
  app::print("  harm off by                {:.4f} p95 with one contact, {:.4f} with more\n",
             figures.lone.harm_off_p95, figures.lone.lasting_off_p95);
  app::print("  chance of contact on grip known to {:.0f} %:\n", 100.0 * eval::grip_sd_share);
  for (const eval::ChanceBin& bin : figures.chances) {
    if (bin.plans > 0) {
      app::print("    told {:5.3f} to {:5.3f}: {:.3f} of {:6} plans; touched {}\n", bin.low,
                 bin.high, bin.told, bin.plans, percent(bin.touched));
    }
  }
}

json as_figures(const eval::AtlasFigures& figures) {
  json all;
  const auto add = [&](const std::string& name, const Proportion& share) {
    all["atlas." + name] = share.share;
    all["atlas." + name + ".lo"] = share.low;
    all["atlas." + name + ".hi"] = share.high;
  };
  all["atlas.scenes"] = figures.scenes;
  all["atlas.plans"] = figures.plans;
  add("covered_share", figures.covered);
  add("contact_agreement", figures.agreement);
  add("partner_agreement", figures.partner);
  add("face_agreement", figures.face);
  add("same_choice_share", figures.same_choice);
  all["atlas.impact_speed_off_mps.p50"] = figures.speed_p50;
  all["atlas.impact_speed_off_mps.p95"] = figures.speed_p95;
  all["atlas.impact_speed_off_mps.max"] = figures.speed_max;
  all["atlas.clearance_off_m.p95"] = figures.clearance_p95;
  all["atlas.regret.mean"] = figures.regret_mean;
  all["atlas.regret.p95"] = figures.regret_p95;
  all["atlas.regret_lone.scenes"] = figures.lone.scenes;
  all["atlas.regret_lone.mean"] = figures.lone.mean;
  all["atlas.regret_lone.share"] = figures.lone.share;
  all["atlas.harm_off.p95"] = figures.lone.harm_off_p95;
  all["atlas.harm_off_later.p95"] = figures.lone.lasting_off_p95;
  for (const eval::ChanceBin& bin : figures.chances) {
    const std::string name = fmt::format("chance_from_{:g}", bin.low);
    all["atlas." + name + ".plans"] = bin.plans;
    all["atlas." + name + ".told"] = bin.told;
    add(name + ".touched", bin.touched);
  }
  return all;
}

/// The atlas beside full physics, over encounters of the families that may be trained on.
int check(const AtlasOptions& options) {
  const auto inputs = read_inputs(options.car);
  if (!inputs.has_value()) {
    return refused(inputs.error());
  }
  const auto atlas = atlas::read_atlas(file_of(options, inputs.value()), inputs.value().car);
  if (!atlas.has_value()) {
    return refused(atlas.error());
  }
  const auto splits = read_splits(inputs.value().places);
  if (!splits.has_value()) {
    return refused(splits.error());
  }
  if (options.seed == splits.value().seeds[static_cast<std::size_t>(families::Split::test)]) {
    complain(fmt::format("--seed: want any but the test split's, got {}", *options.seed));
    return bad_input;
  }
  // All but those that are kept for the test split, which seed_for would refuse.
  constexpr std::array<const char*, 7> names{"crossing",    "cut_in",  "cut_out",   "head_on",
                                             "lead_brakes", "one_way", "pedestrian"};
  std::vector<families::Family> families;
  std::vector<std::uint64_t> seeds;
  for (const char* const one : names) {
    auto family = read_family(inputs.value().places, one);
    if (!family.has_value()) {
      return refused(family.error());
    }
    const auto seed =
        families::seed_for(splits.value(), families::Split::calibration, one, std::nullopt);
    if (!seed.has_value()) {
      return refused(seed.error());
    }
    families.push_back(std::move(family).value());
    seeds.push_back(options.seed.value_or(seed.value()));
  }
  long_work::watch_for_interrupt();
  std::vector<std::vector<eval::AtlasRow>> rows(static_cast<std::size_t>(options.scenes));
  in_parallel(rows.size(), options.threads, [&](std::size_t i) {
    if (!long_work::interrupted()) {
      const std::size_t which = i % names.size();
      rows[i] = eval::atlas_rows(families[which], seeds[which], i / names.size(), atlas.value(),
                                 inputs.value().car, inputs.value().harm);
    }
  });
  if (long_work::interrupted()) {
    complain("interrupted; nothing was counted");
    return was_interrupted;
  }
  const eval::AtlasFigures figures = eval::atlas_figures(rows);
  print_figures(figures, as_figures(figures), options.as_json);
  return success;
}

constexpr const char* usual_file = "Default: where saca run looks for it";

void add_common(CLI::App& command, AtlasOptions& options) {
  command.add_option("--car", options.car, "A car's file, or the name of a shipped one")
      ->capture_default_str();
}

}  // namespace

void add_atlas(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("atlas", "The ego's futures under all eight policies, driven beforehand");
  command->require_subcommand(1);
  const auto options = std::make_shared<AtlasOptions>();

  CLI::App* const make = command->add_subcommand(
      "build", "Drive them with full physics and keep them in a file; can be interrupted");
  add_common(*make, *options);
  make->add_option("--output", options->file, usual_file);
  make->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  make->callback([options, &exit_code] { exit_code = build(*options); });

  CLI::App* const carried = command->add_subcommand(
      "package", "Car, tuning, harm model and atlas as one file, which a vehicle reads");
  carried->add_option("FILE", options->file, usual_file);
  add_common(*carried, *options);
  const auto package_file = std::make_shared<std::string>();
  carried->add_option("--output", *package_file, "Default: CAR.vehicle");
  carried->callback([=, &exit_code] { exit_code = package(*options, *package_file); });

  CLI::App* const info =
      command->add_subcommand("info", "What a file holds, and whether it can be used");
  info->add_option("FILE", options->file, usual_file);
  add_common(*info, *options);
  info->add_flag("--json", options->as_json, "For programs");
  info->callback([options, &exit_code] { exit_code = tell(*options); });

  CLI::App* const compare =
      command->add_subcommand("check", "Beside full physics, over encounters of the families");
  compare->add_option("FILE", options->file, usual_file);
  add_common(*compare, *options);
  compare->add_option("--scenes", options->scenes, "Encounters")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  compare->add_option("--seed", options->seed, "Of the samples; default: calibration's");
  compare->add_option("--threads", options->threads, "They do not change the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  compare->add_flag("--json", options->as_json, "For programs");
  compare->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace saca::app
