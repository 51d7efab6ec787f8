#include "saca/lab/paper_comparison/table_json.h"

#include <fmt/core.h>

#include "saca/lab/eval/estimate_text.h"
#include "saca/lab/paper_comparison/table_request.h"

namespace saca::paper_comparison {

using eval::add_estimate;
using eval::Estimate;
using eval::MethodFigures;
using nlohmann::json;

void add_figures(json& out, const TableFigures& figures) {
  const auto add_all = [&](const MethodFigures& one, const std::string& draws) {
    const auto put = [&](const std::string& what, const Estimate& estimate) {
      add_estimate(
          out, fmt::format("tables.{}.{}.{}{}", number_of(*figures.table), one.method, what, draws),
          estimate);
    };
    put("collision_loss", one.collision_loss);
    put("harm", one.harm);
    put("harm_over_aeb", one.over_aeb);
    if (one.twins) {
      put("false_trigger_loss", one.twins->false_trigger_loss);
    }
  };
  for (std::size_t m = 0; m < figures.all.size(); ++m) {
    add_all(figures.few[m], ".ten_draws");
    add_all(figures.all[m], "");
    if (const auto& in_time = figures.in_time[m]) {
      add_estimate(out,
                   fmt::format("tables.{}.{}.collision_loss.in_time", number_of(*figures.table),
                               in_time->method),
                   in_time->collision_loss);
    }
  }
}

void add_figures(json& out, const TimedModel& one) {
  const std::string place =
      fmt::format("tables.4.{}.{}.", number_of(*eval::find_paper_table(one.table)), one.key);
  out[place + "asked"] = one.times.asked;
  out[place + "done"] = one.times.done;
  out[place + "ended"] = one.times.ended;
  out[place + "in_time"] = one.times.in_time;
  add_estimate(out, place + "tokens", one.times.tokens);
  add_estimate(out, place + "seconds", one.times.seconds);
  if (one.times.least_seconds) {
    out[place + "least_seconds"] = *one.times.least_seconds;
  }
}

}  // namespace saca::paper_comparison
