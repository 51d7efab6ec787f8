#include "saca/lab/vehicle_study/atlas_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace saca::vehicle_study {
namespace {

using atlas::AtlasAxes;
using atlas::AtlasKind;
using nlohmann::json;

json values_of(const AtlasAxes::Axis& axis) {
  json values = json::array();
  for (const double value : axis) {
    values.push_back(value);
  }
  return values;
}

std::string hash_text(const atlas::AtlasInfo& info) {
  return fmt::format("{:016x}", info.car);
}

std::string share_text(const Proportion& share) {
  return fmt::format("{:.2f} % ({:.2f} to {:.2f})", 100.0 * share.share, 100.0 * share.low,
                     100.0 * share.high);
}

void add_share(json& all, const std::string& name, const Proportion& share) {
  all["atlas." + name] = share.share;
  all["atlas." + name + ".lo"] = share.low;
  all["atlas." + name + ".hi"] = share.high;
}

std::string chances_text(const eval::ChanceBins& chances) {
  std::string text =
      fmt::format("  chance of contact on grip known to {:.0f} %:\n", 100.0 * eval::grip_sd_share);
  for (const eval::ChanceBin& bin : chances) {
    if (bin.plans > 0) {
      text += fmt::format("    told {:5.3f} to {:5.3f}: {:.3f} of {:6} plans; touched {}\n",
                          bin.low, bin.high, bin.told, bin.plans, share_text(bin.touched));
    }
  }
  return text;
}

}  // namespace

json json_of(const AtlasFile& file) {
  const atlas::AtlasInfo& info = file.info;
  json kinds = json::array();
  for (std::size_t kind = 0; kind < atlas::num_atlas_kinds; ++kind) {
    const AtlasAxes& axes = info.grid[kind];
    const bool stops = static_cast<AtlasKind>(kind) == AtlasKind::stop;
    kinds.push_back({{"kind", name(static_cast<AtlasKind>(kind))},
                     {"points", axes.num_nodes()},
                     {"speed_mps", values_of(axes.speeds)},
                     {"grip", values_of(axes.grips)},
                     {"way_m", values_of(axes.ways)},
                     {stops ? "strength" : "target_share", values_of(axes.shares)}});
  }
  return {{"schema", "saca.atlas_info/1"},
          {"version", atlas::atlas_version},
          {"car_hash", hash_text(info)},
          {"bytes", info.bytes},
          {"points", num_nodes(info.grid)},
          {"usable", !file.problem.has_value()},
          {"problem", file.problem ? json(*file.problem) : json()},
          {"kinds", kinds}};
}

std::string text_of(const AtlasFile& file) {
  const atlas::AtlasInfo& info = file.info;
  std::string text = fmt::format("{}: whole, version {}, {} points, {:.1f} MB, car {}\n", file.file,
                                 atlas::atlas_version, num_nodes(info.grid),
                                 1e-6 * static_cast<double>(info.bytes), hash_text(info));
  for (std::size_t kind = 0; kind < atlas::num_atlas_kinds; ++kind) {
    const AtlasAxes& axes = info.grid[kind];
    text += fmt::format("  {:15} {:5} points: {:.4g} to {:.4g} m/s, grip {:.3g} to {:.3g}\n",
                        name(static_cast<AtlasKind>(kind)), axes.num_nodes(), axes.speeds[0],
                        axes.speeds[axes.speeds.size() - 1], axes.grips[0],
                        axes.grips[axes.grips.size() - 1]);
  }
  return text + file.problem.value_or("of " + file.car + " as this program drives it: usable") +
         "\n";
}

json json_of(const eval::AtlasFigures& figures) {
  json all;
  all["atlas.scenes"] = figures.scenes;
  all["atlas.plans"] = figures.plans;
  add_share(all, "covered_share", figures.covered);
  add_share(all, "contact_agreement", figures.agreement);
  add_share(all, "partner_agreement", figures.partner);
  add_share(all, "face_agreement", figures.face);
  add_share(all, "same_choice_share", figures.same_choice);
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
    add_share(all, name + ".touched", bin.touched);
  }
  return all;
}

std::string text_of(const eval::AtlasFigures& figures) {
  std::string text = fmt::format("{} scenes, {} plans that physics does not refuse\n",
                                 figures.scenes, figures.plans);
  text += fmt::format("  within the atlas' bounds   {}\n", share_text(figures.covered));
  text += fmt::format("  agree on contact           {}\n", share_text(figures.agreement));
  text += fmt::format("  on with whom               {}\n", share_text(figures.partner));
  text += fmt::format("  on the ego's face          {}\n", share_text(figures.face));
  text += fmt::format("  impact speed off by        {:.3f} m/s p50, {:.3f} p95, {:.2f} at most\n",
                      figures.speed_p50, figures.speed_p95, figures.speed_max);
  text +=
      fmt::format("  clearance off by           {:.2f} m p95 (below 5 m)\n", figures.clearance_p95);
  text += fmt::format("  regret of choosing by it   {:.4f} mean, {:.4f} p95; none in {}\n",
                      figures.regret_mean, figures.regret_p95, share_text(figures.same_choice));
  text += fmt::format(
      "    where nothing is struck twice: {:.4f} mean in {} scenes, {:.1f} % of all regret\n",
      figures.lone.mean, figures.lone.scenes, 100.0 * figures.lone.share);
  text +=
      fmt::format("  harm off by                {:.4f} p95 with one contact, {:.4f} with more\n",
                  figures.lone.harm_off_p95, figures.lone.lasting_off_p95);
  return text + chances_text(figures.chances);
}

}  // namespace saca::vehicle_study
