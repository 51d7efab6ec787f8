#include "saca/lab/danger_study/check_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>

namespace saca::danger_study {
namespace {

using learned_danger::CheckedCase;
using learned_danger::CheckFigures;
using learned_danger::Margins;
using learned_danger::Share;
using nlohmann::json;

double most_hits_of(const CheckFigures& figures) {
  return learned_danger::upper_bound(figures.hit_given_told_safe,
                                     learned_danger::margin_confidence);
}

std::vector<CheckedCase> those(const std::vector<CheckedCase>& all,
                               const std::function<bool(const CheckedCase&)>& wanted) {
  std::vector<CheckedCase> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), wanted);
  return some;
}

/// The figures of all, or of a bin, under their names.
json figures_json(const std::string& place, const CheckFigures& figures) {
  json all;
  const auto add = [&](const char* name, const Share& share) {
    all[place + name] = share.value();
    all[place + name + ".n"] = share.of;
  };
  add("hit_given_told_safe", figures.hit_given_told_safe);
  all[place + "hit_given_told_safe.hi"] = most_hits_of(figures);
  add("hit_given_just_safe", figures.hit_given_just_safe);
  add("told_safe_given_hit", figures.told_safe_given_hit);
  add("false_alarm", figures.false_alarms);
  add("sign_agreement", figures.agreeing_near);
  all[place + "mean_error_m"] = figures.mean_error_near;
  all[place + "bias_m"] = figures.bias_near;
  all[place + "p99_error_m"] = figures.p99_error_near;
  all[place + "lost_by_acting_m"] = figures.lost_near;
  add("pincer", figures.pincers);
  add("pincer_told", figures.told_of_pincers);
  add("pincer_told_alone", figures.told_alone_of_pincers);
  return all;
}

std::string margin_words(double margin) {
  return margin < Margins::none ? fmt::format("{:.2f}", margin) : "none";
}

std::string row_text(const CheckRow& row) {
  const CheckFigures& figures = row.figures;
  return fmt::format(
      "{:42} {:>7} {:9.3f} {:9.3f} {:9.3f} {:9.2f} {:9.2f} {:9.2f} {:8.3f} {:8.3f} {:8.3f}\n",
      row.name, row.margin, 100.0 * figures.hit_given_told_safe.value(),
      100.0 * most_hits_of(figures), 100.0 * figures.hit_given_just_safe.value(),
      100.0 * figures.told_safe_given_hit.value(), 100.0 * figures.false_alarms.value(),
      100.0 * figures.agreeing_near.value(), figures.mean_error_near, figures.bias_near,
      figures.lost_near);
}

std::string head_text() {
  return fmt::format("{:42} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "",
                     "margin", "hit|safe", "at most", "hit|just", "safe|hit", "false", "sign",
                     "error", "bias", "lost") +
         fmt::format("{:42} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n", "",
                     "[m]", "[%]", "[%]", "[%]", "[%]", "[%]", "[%]", "[m]", "[m]", "[m]");
}

}  // namespace

CheckReport check_report(const std::vector<CheckedCase>& all, const std::optional<Margins>& margins,
                         double value_us) {
  const auto margin_of = [&](const CheckedCase& one) {
    return margins ? margins->at(one.is_straight, one.speed, one.grip, one.num_obstacles) : 0.0;
  };
  CheckReport report{
      .value_us = value_us, .rows = {}, .all = learned_danger::figures_of(all, margin_of)};
  report.rows.push_back({"all, no margin", "danger.net.plain.", "0", std::nullopt,
                         learned_danger::figures_of(all, [](const CheckedCase&) { return 0.0; })});
  if (margins) {
    for (std::size_t bin = 0; bin < learned_danger::num_bins; ++bin) {
      const auto some = those(all, [&](const CheckedCase& one) {
        return learned_danger::bin_of(one.is_straight, one.speed, one.grip, one.num_obstacles) ==
               bin;
      });
      const std::string& name = learned_danger::bin_names()[bin];
      const double margin = margins->metres()[bin];
      report.rows.push_back({name, "danger.net." + name + ".", margin_words(margin), margin,
                             learned_danger::figures_of(some, margin_of)});
    }
    report.rows.push_back(
        {"all, each with its margin", "danger.net.", "", std::nullopt, report.all});
  }
  const auto one_obstacle = [](const CheckedCase& each) { return each.num_obstacles == 1; };
  report.rows.push_back({"one obstacle", "danger.net.one.", "", std::nullopt,
                         learned_danger::figures_of(those(all, one_obstacle), margin_of)});
  report.rows.push_back(
      {"several obstacles", "danger.net.several.", "", std::nullopt,
       learned_danger::figures_of(those(all, std::not_fn(one_obstacle)), margin_of)});
  return report;
}

json json_of(const CheckReport& report) {
  json all;
  all["danger.net.us_batch32"] = report.value_us;
  for (const CheckRow& row : report.rows) {
    all.update(figures_json(row.place, row.figures));
    if (row.bin_margin) {
      all[row.place + "margin_m"] = *row.bin_margin;
    }
  }
  return all;
}

std::string text_of(const CheckReport& report) {
  std::string text =
      fmt::format("a value takes {:.2f} us, 32 at once\n", report.value_us) + head_text();
  for (const CheckRow& row : report.rows) {
    text += row_text(row);
  }
  const CheckFigures& all = report.all;
  return text +
         fmt::format(
             "\npincers, which each obstacle alone leaves a way out of: {} of {} situations with "
             "several obstacles; told unsafe {}, by the highest single value {}\n",
             all.pincers.count, all.pincers.of, all.told_of_pincers.count,
             all.told_alone_of_pincers.count);
}

}  // namespace saca::danger_study
