#include "saca/lab/report/harm_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "saca/base/core/units.h"
#include "saca/lab/report/chart_svg.h"

namespace saca::report {
namespace {

using collision::Face;
using collision::HarmModel;
using collision::RiskCurve;
using world::ActorKind;

// Where each curve comes from, in short: data/harm.toml tells all of it.
constexpr std::string_view occupant_source = "Geisslinger et al. 2023, harm_parameters.json, LR4S";
constexpr std::string_view severe_source = "10 % at: Lubbe et al. 2022; slope: Rosen, Sander";
constexpr std::string_view pedestrian_source = "Rosen, Sander 2009 (GIDAS, adults, car fronts)";
constexpr std::string_view shifted_source = "Rosen, Sander 2009, moved as MAIS 3+ (assumption)";

std::vector<double> over(const std::vector<double>& speeds,
                         const std::function<double(double)>& risk) {
  std::vector<double> values;
  values.reserve(speeds.size());
  for (const double speed : speeds) {
    values.push_back(risk(speed));
  }
  return values;
}

struct NamedFace {
  Face face;
  const char* name;
};
constexpr std::array<NamedFace, 3> faces{
    NamedFace{Face::front, "front"}, NamedFace{Face::left, "side"}, NamedFace{Face::rear, "rear"}};

struct NamedKind {
  ActorKind kind;
  const char* name;
};
constexpr std::array<NamedKind, 3> kinds{NamedKind{ActorKind::pedestrian, "pedestrian"},
                                         NamedKind{ActorKind::bicycle, "cyclist"},
                                         NamedKind{ActorKind::motorcycle, "motorcyclist"}};

const collision::UnprotectedRisk& risk_of(const HarmModel& model, ActorKind kind) {
  return kind == ActorKind::pedestrian ? model.pedestrian
         : kind == ActorKind::bicycle  ? model.cyclist
                                       : model.motorcyclist;
}

/// Harm of an occupant is severe_weight P + killed_weight killed_share P, so P is its share.
double occupant_severe(const HarmModel& model, Face face, double delta_v) {
  const double whole = model.severe_weight + model.killed_weight * model.killed_share;
  return collision::occupant_harm(model, face, delta_v) / whole;
}

std::string weights_words(const HarmModel& model) {
  return fmt::format("weights: MAIS 3+ {:g}, killed {:g} on top (assumption)", model.severe_weight,
                     model.killed_weight);
}

std::vector<double> chart_speeds() {
  std::vector<double> speeds;
  constexpr int most_kmh = 100;
  for (int kmh = 0; kmh <= most_kmh; kmh += 2) {
    speeds.push_back(from_kmh(kmh));
  }
  return speeds;
}

/// A colour for each face or kind; what comes after the first three is dashed.
std::vector<ChartLine> lines_of(const std::vector<HarmRisk>& risks,
                                const std::vector<double>& speeds, HarmOver wanted) {
  constexpr std::array inside{ChartColour::blue, ChartColour::orange, ChartColour::grey};
  constexpr std::array outside{ChartColour::purple, ChartColour::green, ChartColour::ink};
  const auto& colours = wanted == HarmOver::delta_v ? inside : outside;
  std::vector<ChartLine> lines;
  for (const HarmRisk& risk : risks) {
    if (risk.over != wanted) {
      continue;
    }
    ChartLine line{.name = risk.name, .note = risk.source};
    line.colour = colours.at(lines.size() % colours.size());
    line.dashed = lines.size() >= colours.size();
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      line.points.push_back({to_kmh(speeds[i]), risk.values[i]});
    }
    lines.push_back(line);
  }
  return lines;
}

double highest(const std::vector<ChartLine>& lines) {
  double most = 0.0;
  for (const ChartLine& line : lines) {
    for (const Vec2 p : line.points) {
      most = std::max(most, p.y);
    }
  }
  return most;
}

}  // namespace

std::vector<HarmRisk> injury_risks(const HarmModel& model, const std::vector<double>& speeds) {
  std::vector<HarmRisk> risks;
  risks.reserve(faces.size() + 2 * kinds.size());
  for (const auto& [face, name] : faces) {
    risks.push_back(
        {std::string("occupant_") + name + "_severe",
         std::string("occupant, struck in the ") + name + ": MAIS 3+", std::string(occupant_source),
         HarmOver::delta_v,
         over(speeds, [&, face = face](double v) { return occupant_severe(model, face, v); })});
  }
  for (const auto& [kind, name] : kinds) {
    const RiskCurve& curve = risk_of(model, kind).severe;
    risks.push_back({std::string(name) + "_severe", std::string(name) + ": MAIS 3+",
                     std::string(severe_source), HarmOver::closing_speed,
                     over(speeds, [&](double v) { return collision::attributable(curve, v); })});
  }
  for (const auto& [kind, name] : kinds) {
    const RiskCurve& curve = risk_of(model, kind).killed;
    risks.push_back(
        {std::string(name) + "_killed", std::string(name) + ": killed",
         std::string(kind == ActorKind::pedestrian ? pedestrian_source : shifted_source),
         HarmOver::closing_speed,
         over(speeds, [&](double v) { return collision::attributable(curve, v); })});
  }
  return risks;
}

std::vector<HarmRisk> person_harms(const HarmModel& model, const std::vector<double>& speeds) {
  std::vector<HarmRisk> harms;
  harms.reserve(faces.size() + kinds.size());
  for (const auto& [face, name] : faces) {
    harms.push_back({std::string("occupant_") + name + "_harm",
                     std::string("occupant, struck in the ") + name, weights_words(model),
                     HarmOver::delta_v, over(speeds, [&, face = face](double v) {
                       return collision::occupant_harm(model, face, v);
                     })});
  }
  for (const auto& [kind, name] : kinds) {
    harms.push_back({std::string(name) + "_harm", std::string(name) + ", over the closing speed",
                     "at least that of an occupant struck in the side", HarmOver::closing_speed,
                     over(speeds, [&, kind = kind](double v) {
                       return collision::unprotected_harm(model, kind, v);
                     })});
  }
  return harms;
}

std::string harm_svg(const HarmModel& model) {
  const std::vector<double> speeds = chart_speeds();
  const double most_kmh = to_kmh(speeds.back());
  const PlotAxis delta_v{"delta-v", "km/h", 0.0, most_kmh};
  const PlotAxis closing{"closing speed along the normal", "km/h", 0.0, most_kmh};
  const PlotAxis chance{"probability", "", 0.0, 1.0};
  const auto risks = injury_risks(model, speeds);
  const auto harms = person_harms(model, speeds);
  std::vector<ChartLine> both = lines_of(harms, speeds, HarmOver::delta_v);
  for (const ChartLine& line : lines_of(harms, speeds, HarmOver::closing_speed)) {
    both.push_back(line);
  }
  return chart_svg(
      {.heading = "How contact becomes harm",
       .lines = {"What of each risk is due to the impact: the curves of data/harm.toml, less their "
                 "value at no speed at all."},
       .charts = {
           {"Occupants of vehicles", delta_v, chance, lines_of(risks, speeds, HarmOver::delta_v)},
           {"People outside vehicles", closing, chance,
            lines_of(risks, speeds, HarmOver::closing_speed)},
           {"Weighted harm of one person",
            {"delta-v or closing speed", "km/h", 0.0, most_kmh},
            {"harm", "", 0.0, 1.04 * highest(both)},
            both}}});
}

}  // namespace saca::report
