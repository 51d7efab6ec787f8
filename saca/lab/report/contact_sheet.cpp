#include "saca/lab/report/contact_sheet.h"

#include <algorithm>
#include <array>

#include "saca/base/core/contract.h"
#include "saca/lab/report/palette.h"

namespace saca::report {
namespace {

constexpr double sheet_border = 16.0;  // around the sheet [px]
constexpr double sheet_gap = 10.0;     // between thumbnails [px]
constexpr double legend_height = 26.0;

constexpr std::array all_kinds{world::ActorKind::car,     world::ActorKind::van,
                               world::ActorKind::truck,   world::ActorKind::motorcycle,
                               world::ActorKind::bicycle, world::ActorKind::pedestrian,
                               world::ActorKind::obstacle};

/// A sign 16 px wide with its word; moves `at` behind them.
std::string legend_sign(const std::string& drawn, std::string_view word, Vec2& at) {
  std::string out = drawn + svg_text("soft", at + Vec2{21.0, 0.0}, word);
  at.x += 21.0 + text_width(word, usual_font) + 14.0;
  return out;
}

std::string legend_body(std::string_view kind, Vec2& at) {
  const std::string classes = std::string(kind) + " body";
  const std::string swatch = svg_rect(classes, at - Vec2{0.0, 8.0}, {16.0, 9.0}, "rx=\"2\"");
  return legend_sign(swatch, kind, at);
}

/// What all scenes need, as seen from each.
Extent common_ground(const std::vector<SceneView>& scenes) {
  Extent all;
  for (const SceneView& view : scenes) {
    const Extent one = scene_extent(view);
    all.add(one.low);
    all.add(one.high);
  }
  return all;
}

bool occurs(const ContactSheet& sheet, world::ActorKind kind) {
  return std::any_of(sheet.scenes.begin(), sheet.scenes.end(), [&](const SceneView& view) {
    const auto& actors = view.scene.actors;
    return std::any_of(actors.begin(), actors.end(),
                       [&](const world::Actor& actor) { return actor.kind == kind; });
  });
}

std::string legend(const ContactSheet& sheet, Vec2 at) {
  std::string out = legend_body("ego", at);
  for (const world::ActorKind kind : all_kinds) {
    if (occurs(sheet, kind)) {
      out += legend_body(body_class(kind), at);
    }
  }
  const auto has_contacts = [&](std::size_t least) {
    return std::any_of(sheet.scenes.begin(), sheet.scenes.end(),
                       [&](const SceneView& view) { return view.contacts.size() >= least; });
  };
  if (has_contacts(1)) {
    out += legend_sign(svg_star(at + Vec2{8.0, -3.5}, 7.0), "first contact", at);
  }
  if (has_contacts(2)) {
    out += legend_sign(svg_circle("later", at + Vec2{8.0, -3.5}, 5.0), "later contact", at);
  }
  return out;
}

}  // namespace

std::string contact_sheet(const ContactSheet& sheet) {
  expects(!sheet.scenes.empty(), "a sheet has at least one scene");
  expects(sheet.columns >= 1, "columns >= 1");
  const std::size_t columns =
      std::min(static_cast<std::size_t>(sheet.columns), sheet.scenes.size());
  const std::size_t rows = (sheet.scenes.size() + columns - 1) / columns;
  const double width = 2.0 * sheet_border +
                       static_cast<double>(columns) * (sheet.thumbnail.width + sheet_gap) -
                       sheet_gap;
  double y = sheet_border + 18.0;
  std::string body = svg_text("heading", {sheet_border, y},
                              fitted(sheet.heading, heading_font, width - 2.0 * sheet_border));
  for (const std::string& line : sheet.lines) {
    y += 16.0;
    body +=
        svg_text("soft", {sheet_border, y}, fitted(line, usual_font, width - 2.0 * sheet_border));
  }
  y += 12.0;
  const Extent ground = common_ground(sheet.scenes);
  for (std::size_t i = 0; i < sheet.scenes.size(); ++i) {
    const std::size_t row = i / columns;
    const Vec2 at{
        sheet_border + static_cast<double>(i % columns) * (sheet.thumbnail.width + sheet_gap),
        y + static_cast<double>(row) * (sheet.thumbnail.height + sheet_gap)};
    SceneView view = sheet.scenes[i];
    if (sheet.same_ground) {
      view.shown_P = ground;
    }
    body += svg_part(at, sheet.thumbnail, scene_card(view, sheet.thumbnail));
  }
  y += static_cast<double>(rows) * (sheet.thumbnail.height + sheet_gap) + 8.0;
  body += legend(sheet, {sheet_border, y + 4.0});
  const SvgSize size{width, y + legend_height};
  return svg_document(size, sheet.heading,
                      svg_rect("card", {0.5, 0.5}, {size.width - 1.0, size.height - 1.0}) + body);
}

}  // namespace saca::report
