#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "saca/base/core/units.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::scenario {
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
  void optional(std::string_view key, std::optional<double> value) {
    if (value) {
      number(key, *value);
    }
  }
  /// Left out when it is what a reader takes it for without.
  void unless(std::string_view key, double value, double usual) {
    if (value != usual) {
      number(key, value);
    }
  }
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
        list += ' ';
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

void write(Writer& out, const Recording& recording) {
  out.column("t_s", recording, [](const Sample& s) { return decimal(s.time); });
  out.column("x_m", recording, [](const Sample& s) { return decimal(s.X_WA.p.x); });
  out.column("y_m", recording, [](const Sample& s) { return decimal(s.X_WA.p.y); });
  out.column("heading_deg", recording, [](const Sample& s) { return degrees(s.X_WA.yaw); });
  out.column("speed_mps", recording, [](const Sample& s) { return decimal(s.speed); });
}

void write_ego(Writer& out, const Recording& recording) {
  write(out, recording);
  out.column("yaw_rate_degps", recording, [](const Sample& s) { return degrees(s.yaw_rate); });
}

void write(Writer& out, const world::LanePose& pose) {
  out.number("s_m", pose.s);
  out.number("d_m", pose.d);
  out.angle("heading_deg", pose.heading);
}

void write_law(Writer& out, const drivers::DriverLaw& law) {
  out.number("desired_speed_mps", law.desired_speed);
  out.number("time_gap_s", law.time_gap);
  out.number("reaction_s", law.reaction);
  out.number("least_gap_m", law.least_gap);
  out.number("acceleration_mps2", law.acceleration);
  out.number("comfortable_mps2", law.comfortable);
  out.number("hardest_mps2", law.hardest);
}

void write_walk(Writer& out, const Script& script) {
  out.number("decides_at_s", script.from);
  out.text("then", name(script.then));
  out.optional("chance_stop", script.chance_stop);
  out.optional("chance_run", script.chance_run);
  if (script.run_speed > 0.0) {
    out.number("run_mps", script.run_speed);
  }
}

void write(Writer& out, const Script& script) {
  write(out, script.start);
  out.number("speed_mps", script.speed);
  out.text("behaviour", name(script.behaviour));
  switch (script.behaviour) {
    case Behaviour::hold:
    case Behaviour::constant_velocity:
      break;
    case Behaviour::accelerate:
      out.number("acceleration_mps2", script.acceleration);
      out.unless("from_s", script.from, 0.0);
      out.optional("until_mps", script.until_speed);
      break;
    case Behaviour::brake:
      out.number("deceleration_mps2", script.acceleration);
      out.number("brake_at_s", script.from);
      break;
    case Behaviour::lane_change:
      out.number("to_d_m", script.to_d);
      out.number("begins_at_s", script.from);
      out.number("takes_s", script.takes);
      out.unless("deceleration_mps2", script.acceleration, 0.0);
      break;
    case Behaviour::follow:
      write_law(out, script.law);
      break;
    case Behaviour::walk:
      write_walk(out, script);
      break;
  }
}

/// Only what is not perfect; nothing when all is.
void write(Writer& out, const PerceptionModel& model) {
  const PerceptionModel perfect;
  if (model == perfect) {
    return;
  }
  out.heading("[perception]");
  out.unless("position_sd_m", model.position_sd, perfect.position_sd);
  out.unless("velocity_sd_mps", model.velocity_sd, perfect.velocity_sd);
  if (model.heading_sd != perfect.heading_sd) {
    out.angle("heading_sd_deg", model.heading_sd);
  }
  out.unless("correlation_s", model.correlation_time, perfect.correlation_time);
  out.unless("latency_s", model.latency, perfect.latency);
  out.unless("dropout", model.dropout, perfect.dropout);
  out.unless("range_m", model.range, perfect.range);
  if (model.occlusion) {
    out.flag("occlusion", true);
  }
  out.unless("confirmation_s", model.confirmation, perfect.confirmation);
  out.unless("memory_s", model.memory, perfect.memory);
  out.optional("grip_believed", model.grip_believed);
  out.unless("grip_sd", model.grip_sd, perfect.grip_sd);
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
  out.text("shape", world::name(actor.footprint.shape));
  out.number("length_m", actor.footprint.length);
  if (actor.footprint.shape != world::Shape::segment) {
    out.number("width_m", actor.footprint.width);
  }
  out.number("mass_kg", actor.mass);
  if (actor.ghost) {
    out.flag("ghost", true);
    out.number("existence", actor.existence);
  }
  if (const auto* recording = std::get_if<Recording>(&actor.motion)) {
    out.heading("[actors.recording]");
    write(out, *recording);
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
  if (!scenario.why.empty()) {
    out.text("why", scenario.why);
  }
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
  write(out, scenario.perception);
  write(out, scenario.road);
  if (const auto* recording = std::get_if<Recording>(&scenario.ego)) {
    out.heading("[ego.recording]");
    write_ego(out, *recording);
  } else {
    const auto& start = std::get<EgoStart>(scenario.ego);
    out.heading("[ego.start]");
    write(out, start.pose);
    out.number("speed_mps", start.speed);
  }
  for (const ScenarioActor& actor : scenario.actors) {
    write(out, actor);
  }
  for (const world::Cue& cue : scenario.cues) {
    out.heading("[[cues]]");
    out.text("kind", world::name(cue.kind));
    out.number("x_m", cue.p_W.x);
    out.number("y_m", cue.p_W.y);
  }
  return std::move(out).take();
}

}  // namespace saca::scenario
