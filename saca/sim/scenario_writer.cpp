#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "saca/core/units.h"
#include "saca/sim/scenario.h"

namespace saca::sim {
namespace {

/// The shortest decimal that reads back as the same number.
std::string decimal(double value) {
  if (value == 0.0) {
    return "0";  // also for -0, which TOML's integers do not have
  }
  std::array<char, 32> digits{};
  const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

/// An angle [rad] as degrees that read back as the same angle, where there are such: turning
/// degrees into radians skips some doubles.
std::string degrees(double angle) {
  const double about = to_degrees(angle);
  // First a short decimal, as people write them.
  for (int digits = 0; digits <= 12; ++digits) {
    const double scale = std::pow(10.0, digits);
    const double rounded = std::round(about * scale) / scale;
    if (from_degrees(rounded) == angle) {
      return decimal(rounded);
    }
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double near :
       {about, std::nextafter(about, infinity), std::nextafter(about, -infinity)}) {
    if (from_degrees(near) == angle) {
      return decimal(near);
    }
  }
  return decimal(about);
}

/// A TOML string; one of several lines keeps them.
std::string quoted(std::string_view text) {
  const bool long_one = text.find('\n') != std::string_view::npos;
  std::string out = long_one ? "\"\"\"\n" : "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c != '\n' && (code < 0x20 || code == 0x7f)) {
      constexpr std::string_view hex = "0123456789ABCDEF";
      out += "\\u00";
      out += hex[code >> 4U];
      out += hex[code & 15U];
      continue;
    }
    if (c == '"' || c == '\\') {
      out += '\\';
    }
    out += c;
  }
  return out + (long_one ? "\"\"\"" : "\"");
}

/// Lines `key = value` under a heading.
class Writer {
 public:
  void heading(std::string_view text) { out_.append("\n").append(text).append("\n"); }
  void raw(std::string_view key, std::string_view value) {
    out_.append(key).append(" = ").append(value).append("\n");
  }
  void text(std::string_view key, std::string_view value) { raw(key, quoted(value)); }
  void number(std::string_view key, double value) { raw(key, decimal(value)); }
  void angle(std::string_view key, double value) { raw(key, degrees(value)); }
  void flag(std::string_view key, bool value) { raw(key, value ? "true" : "false"); }

  /// One column of a recording, in lines of readable length.
  template <class Field>
  void column(std::string_view key, const Recording& recording, Field field) {
    std::string list = "[";
    std::size_t line = key.size() + 3;
    for (const Sample& sample : recording) {
      const std::string item = field(sample) + ",";
      constexpr std::size_t widest = 118;
      if (line + item.size() + 1 > widest) {
        list += "\n  ";
        line = 2;
      } else if (list.size() > 1) {
        list += " ";
      }
      list += item;
      line += item.size() + 1;
    }
    if (list.back() == ',') {
      list.pop_back();
    }
    raw(key, list + "]");
  }

  [[nodiscard]] std::string take() && { return std::move(out_); }

 private:
  std::string out_;
};

void write(Writer& out, const Recording& recording, bool with_yaw_rate) {
  out.column("t_s", recording, [](const Sample& s) { return decimal(s.time); });
  out.column("x_m", recording, [](const Sample& s) { return decimal(s.X_WA.p.x); });
  out.column("y_m", recording, [](const Sample& s) { return decimal(s.X_WA.p.y); });
  out.column("heading_deg", recording, [](const Sample& s) { return degrees(s.X_WA.yaw); });
  out.column("speed_mps", recording, [](const Sample& s) { return decimal(s.speed); });
  if (with_yaw_rate) {
    out.column("yaw_rate_degps", recording, [](const Sample& s) { return degrees(s.yaw_rate); });
  }
}

void write(Writer& out, const world::LanePose& pose) {
  out.number("s_m", pose.s);
  out.number("d_m", pose.d);
  out.angle("heading_deg", pose.heading);
}

void write(Writer& out, const Script& script) {
  write(out, script.start);
  out.number("speed_mps", script.speed);
  out.text("behaviour", name(script.behaviour));
  if (script.behaviour == Behaviour::accelerate) {
    out.number("acceleration_mps2", script.acceleration);
  } else if (script.behaviour == Behaviour::brake) {
    out.number("deceleration_mps2", script.acceleration);
    out.number("brake_at_s", script.from);
  }
}

void write(Writer& out, const world::Road& road) {
  out.heading("[road]");
  out.text("topology", world::name(road.topology));
  out.number("x_m", road.X_WL.p.x);
  out.number("y_m", road.X_WL.p.y);
  out.angle("heading_deg", road.X_WL.yaw);
  out.number("curvature_1pm", road.curvature);
  out.number("lane_width_m", road.lane_width);
  out.number("left_edge_m", road.left_edge);
  out.number("right_edge_m", road.right_edge);
  out.text("left_beyond", world::name(road.left_beyond));
  out.text("right_beyond", world::name(road.right_beyond));
  out.flag("oncoming_left", road.oncoming_left);
  out.flag("oncoming_right", road.oncoming_right);
}

void write(Writer& out, const ScenarioActor& actor) {
  out.heading("[[actors]]");
  out.text("kind", world::name(actor.kind));
  out.raw("id", std::to_string(actor.id));
  out.text("shape", actor.footprint.shape == world::Shape::box ? "box" : "ellipse");
  out.number("length_m", actor.footprint.length);
  out.number("width_m", actor.footprint.width);
  out.number("mass_kg", actor.mass);
  if (const auto* recording = std::get_if<Recording>(&actor.motion)) {
    out.heading("[actors.recording]");
    write(out, *recording, false);
  } else {
    out.heading("[actors.start]");
    write(out, std::get<Script>(actor.motion));
  }
}

}  // namespace

std::string write_scenario(const Scenario& scenario) {
  Writer out;
  out.text("schema", "saca.scenario/1");
  out.text("name", scenario.name);
  out.text("title", scenario.title);
  out.text("source", scenario.source);
  out.text("licence", scenario.licence);
  if (!scenario.driver.empty()) {
    out.text("driver", scenario.driver);
  }
  if (!scenario.notes.empty()) {
    out.text("notes", scenario.notes);
  }
  out.text("car", scenario.car);
  out.number("grip", scenario.grip);
  out.number("duration_s", scenario.duration);
  if (const auto& from = scenario.provenance) {
    out.heading("[provenance]");
    out.raw("event", std::to_string(from->event));
    out.raw("first_row", std::to_string(from->first_row));
    out.raw("last_row", std::to_string(from->last_row));
  }
  write(out, scenario.road);
  if (const auto* recording = std::get_if<Recording>(&scenario.ego)) {
    out.heading("[ego.recording]");
    write(out, *recording, true);
  } else {
    const auto& start = std::get<EgoStart>(scenario.ego);
    out.heading("[ego.start]");
    write(out, start.pose);
    out.number("speed_mps", start.speed);
  }
  for (const ScenarioActor& actor : scenario.actors) {
    write(out, actor);
  }
  return std::move(out).take();
}

}  // namespace saca::sim
