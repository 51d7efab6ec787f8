#include "saca/lab/report/map_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "saca/lab/report/palette.h"

namespace saca::report {
namespace {

using manoeuvre::PolicyId;

constexpr double row_height = 19.0;  // [px]

std::string count_words(std::ptrdiff_t count, std::size_t all) {
  return fmt::format("{}  ({:.1f} %)", count,
                     100.0 * static_cast<double>(count) / static_cast<double>(all));
}

}  // namespace

int area_key(const MapCell& cell) {
  return cell.verdict == MapVerdict::decided   ? static_cast<int>(manoeuvre::index(cell.best))
         : cell.verdict == MapVerdict::no_risk ? no_risk_key
                                               : no_scene_key;
}

bool refuses(const MapCell& cell, PolicyId policy) {
  return cell.verdict != MapVerdict::unplayable && cell.refused.at(manoeuvre::index(policy));
}

std::vector<PolicyId> refused_somewhere(std::span<const MapCell> cells) {
  std::vector<PolicyId> found;
  std::copy_if(manoeuvre::all_policies.begin(), manoeuvre::all_policies.end(),
               std::back_inserter(found), [&](PolicyId policy) {
                 return std::any_of(cells.begin(), cells.end(),
                                    [&](const MapCell& cell) { return refuses(cell, policy); });
               });
  return found;
}

std::string nominal_mark(Vec2 at) {
  std::string out;
  for (const std::string_view looks : {"nominal-halo", "nominal"}) {
    out += svg_circle(looks, at, 6.0);
    out += svg_line(looks, at - Vec2{10.0, 0.0}, at + Vec2{10.0, 0.0});
    out += svg_line(looks, at - Vec2{0.0, 10.0}, at + Vec2{0.0, 10.0});
  }
  return out;
}

void MapLegend::heading(std::string_view words) {
  body_ += svg_text("strong", at_ + Vec2{0.0, 4.0}, words);
  at_.y += row_height;
}

void MapLegend::swatch(const Looks& looks, std::string_view words, std::string_view count) {
  constexpr SvgSize size{18.0, 12.0};
  const Vec2 corner = at_ - Vec2{0.0, 6.0};
  for (const std::string_view one : looks) {
    body_ += svg_rect(one, corner, size);
  }
  body_ += svg_rect("frame", corner, size);
  body_ += svg_text("", at_ + Vec2{25.0, 4.0}, words);
  if (!count.empty()) {
    body_ += svg_text("soft", {at_.x + legend_width - map_border, at_.y + 4.0}, count, Anchor::end);
  }
  at_.y += row_height;
}

void MapLegend::sign(const std::string& drawn, std::string_view words) {
  body_ += drawn;
  body_ += svg_text("", at_ + Vec2{25.0, 4.0}, words);
  at_.y += row_height;
}

void MapLegend::gap() {
  at_.y += 0.5 * row_height;
}

void MapLegend::verdicts(std::span<const MapCell> cells) {
  heading("best policy, cells");
  const auto count = [&](int key) {
    return std::count_if(cells.begin(), cells.end(),
                         [key](const MapCell& cell) { return area_key(cell) == key; });
  };
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (const auto n = count(static_cast<int>(manoeuvre::index(policy))); n > 0) {
      const std::string area = policy_area(policy);
      const bool to_the_right = manoeuvre::side(policy) < 0;
      swatch(to_the_right ? Looks{area, "right"} : Looks{area},
             fmt::format("{} {}", manoeuvre::index(policy), manoeuvre::name(policy)),
             count_words(n, cells.size()));
    }
  }
  if (const auto n = count(no_risk_key); n > 0) {
    swatch({"no-risk"}, "no risk", count_words(n, cells.size()));
  }
  if (const auto n = count(no_scene_key); n > 0) {
    swatch({"unplayable"}, "no such scene", count_words(n, cells.size()));
  }
}

void MapLegend::refusals(std::span<const MapCell> cells) {
  const std::vector<PolicyId> refused = refused_somewhere(cells);
  if (refused.empty()) {
    return;
  }
  gap();
  heading("refused from there, cells");
  for (const PolicyId policy : refused) {
    const auto count = std::count_if(cells.begin(), cells.end(),
                                     [&](const MapCell& cell) { return refuses(cell, policy); });
    swatch({"refused"}, fmt::format("{} {}", manoeuvre::index(policy), manoeuvre::name(policy)),
           count_words(count, cells.size()));
  }
}

void MapLegend::margins() {
  heading("margin in harm over the next");
  const std::array words{fmt::format("below {:g}", margin_steps[0]),
                         fmt::format("{:g} to {:g}", margin_steps[0], margin_steps[1]),
                         fmt::format("{:g} to {:g}", margin_steps[1], margin_steps[2]),
                         fmt::format("{:g} or more", margin_steps[2])};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string looks = fmt::format("p7 m{}", i + 1);
    swatch({looks}, words.at(i), "");
  }
}

}  // namespace saca::report
