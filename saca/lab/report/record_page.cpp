#include "saca/lab/report/record_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "saca/base/core/contract.h"
#include "saca/base/formats/json_reader.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/report/page.h"
#include "saca/lab/report/record_in_words.h"
#include "saca/lab/report/value_map.h"

namespace saca::report {
namespace {

constexpr std::string_view css_marker = "/* style */";
constexpr std::string_view record_marker = "\"record.json\"";
constexpr std::string_view told_marker = "\"explanation.json\"";  // of an encounter's page only
constexpr std::string_view js_marker = "/* script */";

std::optional<Error> problem(std::string_view record_json, std::string_view schema) {
  const auto read = formats::parse_json(record_json);
  if (!read.has_value()) {
    return Error{Error::Code::malformed, "record: " + read.error().message};
  }
  const nlohmann::json& record = read.value();
  if (!record.is_object() || !record.contains("schema")) {
    return Error{Error::Code::malformed, "record: schema: want \"" + std::string(schema) +
                                             "\", got a document without one"};
  }
  if (record["schema"] != schema) {
    return Error{Error::Code::malformed, "record: schema: want \"" + std::string(schema) +
                                             "\", got " +
                                             formats::JsonReader::shown(record["schema"])};
  }
  return std::nullopt;
}

/// The same JSON without the characters that mean something to HTML or to old JavaScript. They
/// occur inside strings only, where JSON allows the escape.
std::string harmless(std::string_view record) {
  // U+2028 and U+2029, which JavaScript once took for line ends, are E2 80 A8 and E2 80 A9 in
  // UTF-8.
  constexpr std::string_view separator = "\xE2\x80";
  std::string text;
  text.reserve(record.size() + record.size() / 64);
  for (std::size_t i = 0; i < record.size(); ++i) {
    if (record[i] == '<') {
      text += "\\u003c";
    } else if (record.substr(i, 3) == "\xE2\x80\xA8" || record.substr(i, 3) == "\xE2\x80\xA9") {
      text += record[i + separator.size()] == '\xA8' ? "\\u2028" : "\\u2029";
      i += separator.size();
    } else {
      text += record[i];
    }
  }
  return text;
}

/// Puts `text` where the page has `marker`, and moves `rest` behind it.
void fill(std::string& page, std::string_view& rest, std::string_view marker,
          std::string_view text) {
  const std::size_t at = rest.find(marker);
  expects(at != std::string_view::npos, "a page of viewer/ has its markers, in order");
  page += rest.substr(0, at);
  page += text;
  rest.remove_prefix(at + marker.size());
}

std::string list_of(const std::array<Rgb, 6>& colours) {
  std::string text;
  for (const Rgb& c : colours) {
    text += fmt::format("{}#{:02x}{:02x}{:02x}", text.empty() ? "" : ", ", c.red, c.green, c.blue);
  }
  return text;
}

/// Colours of values, from 0 outwards, for style and script.
std::string value_colours() {
  return fmt::format(":root {{ --value-danger: {}; --value-safety: {}; }}\n",
                     list_of(danger_colours), list_of(safety_colours));
}

/// What `saca explain` says of it; empty where it lacks what that needs.
std::string told(std::string_view record_json) {
  nlohmann::json paragraphs = nlohmann::json::array();
  if (const auto all = explanation(record_json, "record"); all.has_value()) {
    for (const Paragraph& one : all.value()) {
      paragraphs.push_back({{"about", one.about}, {"sentences", one.sentences}});
    }
  }
  return paragraphs.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// @param more_css  that follows the page's own
Result<std::string> filled(const Page& page, std::string_view record_json, std::string_view schema,
                           const std::string& more_css = {}) {
  if (auto error = problem(record_json, schema)) {
    return *std::move(error);
  }
  const std::string record = harmless(record_json);
  std::string text;
  text.reserve(page.html.size() + page.css.size() + page.js.size() + record.size());
  std::string_view rest = page.html;
  fill(text, rest, css_marker, std::string(page.css) + more_css);
  fill(text, rest, record_marker, record);
  if (rest.find(told_marker) != std::string_view::npos) {
    fill(text, rest, told_marker, harmless(told(record_json)));
  }
  fill(text, rest, js_marker, page.js);
  text += rest;
  return text;
}

}  // namespace

Result<std::string> html_report(std::string_view record_json) {
  return filled(encounter_page, record_json, "saca.record/1", value_colours());
}

Result<std::string> drive_report(std::string_view record_json) {
  return filled(drive_page, record_json, "saca.drive/1");
}

Result<std::string> value_report(std::string_view record_json) {
  return filled(value_page, record_json, "saca.value_page/1");
}

}  // namespace saca::report
