#include "saca/lab/suites/shadow_rows.h"

#include <fmt/core.h>

#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "saca/base/core/printable.h"
#include "saca/base/formats/json_text.h"

namespace saca::suites {
namespace {

nlohmann::json json_of_trigger(const ShadowTrigger& trigger) {
  const eval::ShadowJudgement& told = trigger.judgement;
  return nlohmann::json::array(
      {trigger.time, trigger.who, trigger.time_to_conflict, trigger.speed, name(told.reason),
       told.driver_deceleration, told.other_deceleration, told.driver_lateral_acceleration,
       told.needed_deceleration ? nlohmann::json(*told.needed_deceleration) : nlohmann::json(),
       told.least_gap});
}

ShadowTrigger trigger_from(const nlohmann::json& in) {
  ShadowTrigger trigger{.time = in.at(0).get<double>(),
                        .who = in.at(1).get<std::string>(),
                        .time_to_conflict = in.at(2).get<double>(),
                        .speed = in.at(3).get<double>(),
                        .judgement = {}};
  eval::ShadowJudgement& told = trigger.judgement;
  const auto reason = eval::shadow_reason_from(in.at(4).get<std::string>());
  if (!reason) {
    throw std::runtime_error("want the name of a reason");
  }
  told.reason = *reason;
  told.driver_deceleration = in.at(5).get<double>();
  told.other_deceleration = in.at(6).get<double>();
  told.driver_lateral_acceleration = in.at(7).get<double>();
  if (!in.at(8).is_null()) {
    told.needed_deceleration = in.at(8).get<double>();
  }
  told.least_gap = in.at(9).get<double>();
  return trigger;
}

eval::Rate rate_of(int count, double exposure) {
  return exposure > 0.0 ? eval::poisson_rate(count, exposure) : eval::Rate{.count = count};
}

void count(const ShadowTrigger& trigger, ShadowCounts& counts) {
  constexpr double rest_speed = 0.5;  // [m/s]
  ++counts.reasons[trigger.judgement.reason];
  counts.at_rest += trigger.speed < rest_speed ? 1 : 0;
  counts.danger += is_danger(trigger.judgement.reason) ? 1 : 0;
}

void add_rates(int number, double hours, double thousands, ShadowCounts& counts) {
  counts.per_hour = rate_of(number, hours);
  counts.per_1000km = rate_of(number, thousands);
  counts.false_per_hour = rate_of(number - counts.danger, hours);
  counts.false_per_1000km = rate_of(number - counts.danger, thousands);
}

}  // namespace

std::string line_of(const ShadowRow& row) {
  nlohmann::json line{{"source", row.source}, {"drive", row.drive}};
  if (!row.left_out.empty()) {
    line["left_out"] = row.left_out;
    if (row.failed) {
      line["failed"] = true;
    }
  } else {
    line["seconds"] = row.watched.seconds;
    line["metres"] = row.watched.metres;
    line["previews"] = nlohmann::json::array();
    for (const ShadowPreview& preview : row.watched.previews) {
      line["previews"].push_back(nlohmann::json::array({preview.from, preview.to, preview.who}));
    }
    line["triggers"] = nlohmann::json::array();
    for (const ShadowTrigger& trigger : row.watched.triggers) {
      line["triggers"].push_back(json_of_trigger(trigger));
    }
    line["interventions"] = nlohmann::json::array();
    for (const ShadowIntervention& begun : row.watched.interventions) {
      line["interventions"].push_back(
          nlohmann::json::array({json_of_trigger(begun.trigger), begun.plan, begun.early}));
    }
  }
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<ShadowRow> shadow_row_from(std::string_view line) {
  try {
    const auto read = formats::parse_json(line);
    if (!read.has_value()) {
      return Error{Error::Code::malformed, "want one watched drive: " + read.error().message};
    }
    const nlohmann::json& in = read.value();
    ShadowRow row{.source = in.at("source").get<std::string>(),
                  .drive = in.at("drive").get<std::string>(),
                  .left_out = in.value("left_out", std::string()),
                  .failed = in.value("failed", false),
                  .watched = {}};
    if (row.left_out.empty()) {
      row.watched.seconds = in.at("seconds").get<double>();
      row.watched.metres = in.at("metres").get<double>();
      for (const auto& preview : in.at("previews")) {
        row.watched.previews.push_back({preview.at(0).get<double>(), preview.at(1).get<double>(),
                                        preview.at(2).get<std::string>()});
      }
      for (const auto& trigger : in.at("triggers")) {
        row.watched.triggers.push_back(trigger_from(trigger));
      }
      for (const auto& begun : in.at("interventions")) {
        row.watched.interventions.push_back(
            {trigger_from(begun.at(0)), begun.at(1).get<std::string>(), begun.at(2).get<bool>()});
      }
    }
    return row;
  } catch (const std::exception& problem) {
    return Error{Error::Code::malformed, fmt::format("want one watched drive, got \"{}\": {}",
                                                     one_line(line, 80), one_line(problem.what()))};
  }
}

ShadowFigures shadow_figures(std::span<const ShadowRow> rows, std::string_view source) {
  ShadowFigures figures;
  int previews = 0;
  int triggers = 0;
  int interventions = 0;
  for (const ShadowRow& row : rows) {
    if (!source.empty() && row.source != source) {
      continue;
    }
    if (!row.left_out.empty()) {
      ++figures.left_out;
      figures.failed += row.failed ? 1 : 0;
      continue;
    }
    ++figures.drives;
    figures.hours += row.watched.seconds / 3600.0;
    figures.kilometres += row.watched.metres / 1000.0;
    previews += static_cast<int>(row.watched.previews.size());
    triggers += static_cast<int>(row.watched.triggers.size());
    interventions += static_cast<int>(row.watched.interventions.size());
    for (const ShadowTrigger& trigger : row.watched.triggers) {
      count(trigger, figures.triggers);
    }
    for (const ShadowIntervention& begun : row.watched.interventions) {
      count(begun.trigger, figures.interventions);
      figures.early += begun.early ? 1 : 0;
    }
  }
  const double thousands = figures.kilometres / 1000.0;
  figures.previews_per_hour = rate_of(previews, figures.hours);
  figures.previews_per_1000km = rate_of(previews, thousands);
  add_rates(triggers, figures.hours, thousands, figures.triggers);
  add_rates(interventions, figures.hours, thousands, figures.interventions);
  return figures;
}

}  // namespace saca::suites
