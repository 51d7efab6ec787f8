#include "saca/lab/report/scene_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/base/core/contract.h"
#include "saca/base/core/units.h"
#include "saca/lab/report/palette.h"
#include "saca/lab/report/picture_frame.h"
#include "saca/lab/report/road_svg.h"

namespace saca::report {
namespace {

constexpr double card_margin = 8.0;    // around title and picture [px]
constexpr double title_height = 16.0;  // [px]
constexpr double line_height = 13.5;   // [px]

/// One body on its way through the picture.
struct Moving {
  std::string_view looks;  ///< class
  std::string name;        ///< empty: the ego
  const world::Footprint* footprint;
  const world::Track* track;
  bool has_glass;
  bool is_person;
};

std::array<Vec2, 4> corners(const world::Footprint& footprint, const Pose& X_WB) {
  const double l = footprint.length / 2.0;
  const double w = footprint.width / 2.0;
  const double c = footprint.centre_x;
  return {X_WB * Vec2{c + l, w}, X_WB * Vec2{c - l, w}, X_WB * Vec2{c - l, -w},
          X_WB * Vec2{c + l, -w}};
}

Pose lane_frame_at_ego(const world::Scene& scene) {
  const double s = world::to_lane(scene.road, scene.ego.X_WB).s;
  return inverse(world::from_lane(scene.road, {s, 0.0, 0.0}));
}

/// A car, van or truck shows by its windscreen where it heads.
bool has_windscreen(world::ActorKind kind) {
  return kind == world::ActorKind::car || kind == world::ActorKind::van ||
         kind == world::ActorKind::truck;
}

/// What is drawn at which times.
class Drawing {
 public:
  Drawing(const SceneView& view, SvgSize size) : view_(view), start_(view.scene.time) {
    expects(view.others.size() == view.scene.actors.size(), "one track per actor of the scene");
    for (std::size_t i = 0; i < view.others.size(); ++i) {
      const world::Actor& actor = view.scene.actors[i];
      bodies_.push_back({body_class(actor.kind), world::actor_name(actor), &actor.footprint,
                         &view.others[i], has_windscreen(actor.kind),
                         actor.kind == world::ActorKind::pedestrian});
    }
    if (view.ego.X_WA.empty()) {
      stands_.X_WA = {view.scene.ego.X_WB};
    }
    bodies_.push_back({"ego", "", &view.scene.ego_footprint,
                       view.ego.X_WA.empty() ? &stands_ : &view.ego, true, false});
    end_ = std::max(start_, world::end_time(*bodies_.back().track));
    for (const collision::Contact& contact : view.contacts) {
      end_ = std::max(end_, contact.time);
    }
    frame_ = framed(lane_frame_at_ego(view.scene), view.shown_P.value_or(extent()), size);
  }

  // It points into itself.
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  [[nodiscard]] const PictureFrame& frame() const { return frame_; }

  /// What is to be seen: the ego's way, all contacts, and of the others what is near that.
  [[nodiscard]] Extent extent() const {
    const Pose X_PW = lane_frame_at_ego(view_.scene);
    const double last_contact = view_.contacts.empty() ? start_ : view_.contacts.back().time;
    const std::vector<double> times = ghost_times();
    Extent seen;
    for (const double time : times) {
      const Extent box = extent_of(bodies_.back(), time, X_PW);
      if (time <= last_contact || (box.low.x > -longest_view && box.high.x < longest_view)) {
        seen.add(box.low);
        seen.add(box.high);
      }
    }
    for (const collision::Contact& contact : view_.contacts) {
      seen.add(X_PW * contact.p_W);
    }
    constexpr Vec2 near{9.0, 6.0};  // [m]
    const Extent interesting = seen.grown(near);
    for (const Moving& body : bodies_) {
      for (const double time : times) {
        const Extent box = extent_of(body, time, X_PW);
        if (box.meets(interesting)) {
          seen.add(interesting.nearest(box.low));
          seen.add(interesting.nearest(box.high));
        }
      }
    }
    constexpr Vec2 room{2.5, 1.8};         // around it all [m]
    constexpr Vec2 half_least{14.0, 4.5};  // of the smallest picture [m]
    Extent wide = seen.grown(room);
    wide.add(seen.middle() + half_least);
    wide.add(seen.middle() - half_least);
    return wide;
  }

  [[nodiscard]] std::string picture() const {
    std::string out = road_svg(view_.scene.road, frame_) + fan_svg(view_.fan, frame_);
    for (const Moving& body : bodies_) {
      out += trail(body);
    }
    for (const Moving& body : bodies_) {
      out += ghosts(body);
    }
    out += touching_bodies();
    for (const Moving& body : bodies_) {
      out += outline("body", body, end_, "");
      out += body.has_glass ? windscreen(body) : "";
      out += body.is_person ? person(body) : "";
    }
    out += stars() + names() + scale_bar();
    return view_.ego.X_WA.empty() ? "<g class=\"faded\">\n" + out + "</g>\n" : out;
  }

 private:
  [[nodiscard]] Pose at(const Moving& body, double time) const {
    return world::pose_at(*body.track, time);
  }

  /// Between two ghosts: a quarter of a second, longer in long stories.
  [[nodiscard]] double ghost_step() const {
    constexpr double most_ghosts = 10.0;
    const double duration = end_ - start_;
    return duration / 0.25 <= most_ghosts ? 0.25 : duration / 0.5 <= most_ghosts ? 0.5 : 1.0;
  }

  [[nodiscard]] std::vector<double> ghost_times() const {
    std::vector<double> times;
    const double step = ghost_step();
    for (int k = 0; start_ + k * step < end_ - 1e-9; ++k) {
      times.push_back(start_ + k * step);
    }
    times.push_back(end_);
    return times;
  }

  [[nodiscard]] Extent extent_of(const Moving& body, double time, const Pose& X_PW) const {
    Extent box;
    for (const Vec2 p_W : corners(*body.footprint, at(body, time))) {
      box.add(X_PW * p_W);
    }
    return box;
  }

  [[nodiscard]] std::string outline(std::string_view what, const Moving& body, double time,
                                    std::string_view more) const {
    const std::string classes = fmt::format("{} {}", body.looks, what);
    const Pose X_WB = at(body, time);
    const world::Footprint& footprint = *body.footprint;
    if (footprint.shape != world::Shape::ellipse) {
      std::array<Vec2, 4> points = corners(footprint, X_WB);
      std::transform(points.begin(), points.end(), points.begin(),
                     [this](Vec2 p_W) { return frame_.px(p_W); });
      return svg_polygon(classes, points, more);
    }
    const Vec2 middle = frame_.px(X_WB * Vec2{footprint.centre_x, 0.0});
    return fmt::format(
        "<ellipse class=\"{0}\" cx=\"{1}\" cy=\"{2}\" rx=\"{3}\" ry=\"{4}\" "
        "transform=\"rotate({5} {1} {2})\"{6}{7}/>\n",
        classes, svg_number(middle.x), svg_number(middle.y),
        svg_number(frame_.scale * footprint.length / 2.0),
        svg_number(frame_.scale * footprint.width / 2.0),
        svg_number(-to_degrees(wrap_angle(X_WB.yaw + frame_.X_PW.yaw))), more.empty() ? "" : " ",
        more);
  }

  [[nodiscard]] std::string ghosts(const Moving& body) const {
    std::string out;
    std::optional<Pose> drawn;
    for (const double time : ghost_times()) {
      const Pose X_WB = at(body, time);
      constexpr double unmoved = 0.3;   // [m]
      constexpr double unturned = 0.1;  // [rad]
      if (time >= end_ || (drawn && norm(X_WB.p - drawn->p) < unmoved &&
                           std::abs(wrap_angle(X_WB.yaw - drawn->yaw)) < unturned)) {
        continue;
      }
      drawn = X_WB;
      const double share = (time - start_) / (end_ - start_);
      out += outline("ghost", body, time,
                     fmt::format("stroke-opacity=\"{}\" fill-opacity=\"{}\"",
                                 svg_number(0.25 + 0.6 * share), svg_number(0.05 + 0.2 * share)));
    }
    return out;
  }

  [[nodiscard]] std::string trail(const Moving& body) const {
    constexpr double step = 0.1;  // [s]
    std::vector<Vec2> points;
    double way = 0.0;
    for (int k = 0; start_ + k * step < end_; ++k) {
      points.push_back(frame_.px(at(body, start_ + k * step).p));
    }
    points.push_back(frame_.px(at(body, end_).p));
    for (std::size_t k = 1; k < points.size(); ++k) {
      way += norm(points[k] - points[k - 1]);
    }
    constexpr double least_way = 2.0;  // [px]
    return way < least_way ? "" : svg_polyline(fmt::format("{} trail", body.looks), points);
  }

  /// Both bodies as they were when they touched.
  [[nodiscard]] std::string touching_bodies() const {
    std::string out;
    for (const collision::Contact& contact : view_.contacts) {
      out += outline("touch", bodies_.back(), contact.time, "");
      if (contact.actor) {
        expects(*contact.actor < view_.others.size(), "a contact is with an actor of the scene");
        out += outline("touch", bodies_[*contact.actor], contact.time, "");
      }
    }
    return out;
  }

  [[nodiscard]] std::string windscreen(const Moving& body) const {
    const world::Footprint& footprint = *body.footprint;
    const double l = footprint.length / 2.0;
    const double w = footprint.width / 2.0;
    const double back = std::max(0.28 * l, l - 1.9);  // of a long body: near its front
    const double front = std::max(0.5 * l, l - 1.3);
    const Pose X_WB = at(body, end_);
    std::array<Vec2, 4> points;
    const std::array<Vec2, 4> glass{Vec2{front, 0.72 * w}, Vec2{back, 0.62 * w},
                                    Vec2{back, -0.62 * w}, Vec2{front, -0.72 * w}};
    std::transform(glass.begin(), glass.end(), points.begin(), [&](Vec2 p) {
      return frame_.px(X_WB * (p + Vec2{footprint.centre_x, 0.0}));
    });
    return svg_polygon("glass", points);
  }

  /// A ring by which a small body is found.
  [[nodiscard]] std::string person(const Moving& body) const {
    constexpr double radius = 6.0;  // [px]
    return svg_circle("person", frame_.px(at(body, end_).p), radius);
  }

  [[nodiscard]] std::string stars() const {
    std::string out;
    for (std::size_t i = view_.contacts.size(); i-- > 0;) {
      const Vec2 at = frame_.px(view_.contacts[i].p_W);
      if (i == 0) {
        out += svg_star(at, 9.0);
      } else {
        out += svg_circle("later", at, 6.0);
        out += svg_text("strong", at + Vec2{0.0, 4.0}, fmt::format("{}", i + 1), Anchor::middle);
      }
    }
    return out;
  }

  /// Names beside the bodies where they end, and nothing over what is written already.
  [[nodiscard]] std::string names() const {
    const SvgSize size = frame_.size();
    std::vector<Extent> taken;
    std::string out;
    for (const Moving& body : bodies_) {
      Extent box;
      for (const Vec2 p_W : corners(*body.footprint, at(body, end_))) {
        box.add(frame_.px(p_W));
      }
      const Extent card{{0.0, 0.0}, {size.width, size.height}};
      if (body.name.empty() || !box.meets(card)) {
        continue;
      }
      const double half = text_width(body.name, usual_font) / 2.0;
      const double x = std::clamp(box.middle().x, half + 2.0, size.width - half - 2.0);
      for (const double y : {box.low.y - 3.0, box.high.y + usual_font}) {
        const Extent words{{x - half, y - usual_font}, {x + half, y}};
        const bool fits = words.low.y > 0.0 && words.high.y < size.height - 1.0 &&
                          std::none_of(taken.begin(), taken.end(),
                                       [&](const Extent& other) { return other.meets(words); });
        if (fits) {
          taken.push_back(words);
          out += svg_text("halo", {x, y}, body.name, Anchor::middle);
          break;
        }
      }
    }
    return out;
  }

  [[nodiscard]] std::string scale_bar() const {
    constexpr double least = 36.0;  // [px]
    double length = 50.0;
    for (const double metres : {20.0, 10.0, 5.0, 2.0, 1.0}) {
      length = metres * frame_.scale >= least ? metres : length;
    }
    const double y = frame_.size().height - 7.0;
    const double end = 8.0 + length * frame_.scale;
    const std::array<Vec2, 4> bar{Vec2{8.0, y - 4.0}, Vec2{8.0, y}, Vec2{end, y},
                                  Vec2{end, y - 4.0}};
    return svg_polyline("scale", bar) +
           svg_text("halo", {end + 4.0, y + 1.0}, fmt::format("{:g} m", length));
  }

  const SceneView& view_;
  double start_;
  double end_ = 0.0;
  world::Track stands_;         // an ego that is not driven
  std::vector<Moving> bodies_;  // the ego last
  PictureFrame frame_;
};

double card_head_height(const SceneView& view) {
  return card_margin + title_height + line_height * static_cast<double>(view.lines.size());
}

SvgSize picture_size(const SceneView& view, SvgSize size) {
  const SvgSize picture{size.width - 2.0 * card_margin,
                        size.height - card_head_height(view) - card_margin};
  expects(picture.width >= 60.0 && picture.height >= 40.0, "the size has room for a picture");
  return picture;
}

std::string card_head(const SceneView& view, SvgSize size) {
  const double baseline = card_margin + 11.0;
  double left = card_margin;
  double right = size.width - card_margin;
  std::string out;
  if (view.policy) {
    constexpr double side = 11.0;
    const Vec2 at{left, baseline - 10.0};
    out += svg_rect(policy_area(*view.policy), at, {side, side}, "rx=\"2\"");
    if (manoeuvre::side(*view.policy) < 0) {
      out += svg_rect("right", at, {side, side}, "rx=\"2\"");
    }
    left += side + 6.0;
  }
  if (!view.badge.empty()) {
    const double width = text_width(view.badge, usual_font) + 12.0;
    right -= width;
    out += svg_rect("badge", {right, baseline - 12.0}, {width, 16.0}, "rx=\"4\"");
    out += svg_text("badge-text", {right + width / 2.0, baseline}, view.badge, Anchor::middle);
    right -= 6.0;
  }
  out += svg_text("title", {left, baseline}, fitted(view.title, title_font, right - left));
  double y = baseline;
  for (const std::string& line : view.lines) {
    y += line_height;
    out += svg_text("soft", {card_margin, y},
                    fitted(line, usual_font, size.width - 2.0 * card_margin));
  }
  return out;
}

}  // namespace

std::string scene_card(const SceneView& view, SvgSize size) {
  const SvgSize picture = picture_size(view, size);
  const Drawing drawing(view, picture);
  const Vec2 at{card_margin, card_head_height(view)};
  return svg_rect("card", {0.5, 0.5}, {size.width - 1.0, size.height - 1.0}, "rx=\"7\"") +
         card_head(view, size) + svg_part(at, picture, drawing.picture()) +
         svg_rect("frame", at, picture);
}

std::string scene_svg(const SceneView& view, SvgSize size) {
  return svg_document(size, view.title, scene_card(view, size));
}

Extent scene_extent(const SceneView& view) {
  return Drawing(view, usual_thumbnail).extent();
}

Vec2 scene_pixel(const SceneView& view, SvgSize size, Vec2 p_W) {
  const Drawing drawing(view, picture_size(view, size));
  return Vec2{card_margin, card_head_height(view)} + drawing.frame().px(p_W);
}

}  // namespace saca::report
