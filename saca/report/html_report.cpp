#include "saca/report/html_report.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "saca/core/contract.h"
#include "saca/report/page.h"

namespace saca::report {
namespace {

constexpr std::string_view schema = "saca.record/1";
constexpr std::string_view css_marker = "/* report.css */";
constexpr std::string_view record_marker = "\"record.json\"";
constexpr std::string_view js_marker = "/* report.js */";

std::optional<Error> problem(std::string_view record_json) {
  nlohmann::json record;
  try {
    record = nlohmann::json::parse(record_json);
  } catch (const nlohmann::json::exception& e) {
    return Error{Error::Code::malformed, std::string("record: want JSON, got: ") + e.what()};
  }
  if (!record.is_object() || !record.contains("schema")) {
    return Error{Error::Code::malformed, "record: schema: want \"" + std::string(schema) +
                                             "\", got a document without one"};
  }
  if (record["schema"] != schema) {
    return Error{Error::Code::malformed, "record: schema: want \"" + std::string(schema) +
                                             "\", got " + record["schema"].dump()};
  }
  return std::nullopt;
}

/// The same JSON without the characters that mean something to HTML or to old JavaScript. They
/// occur inside strings only, where JSON allows the escape.
std::string harmless(std::string_view json) {
  // U+2028 and U+2029, which JavaScript once took for line ends, are E2 80 A8 and E2 80 A9 in
  // UTF-8.
  constexpr std::string_view separator = "\xE2\x80";
  std::string text;
  text.reserve(json.size() + json.size() / 64);
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (json[i] == '<') {
      text += "\\u003c";
    } else if (json.substr(i, 3) == "\xE2\x80\xA8" || json.substr(i, 3) == "\xE2\x80\xA9") {
      text += json[i + separator.size()] == '\xA8' ? "\\u2028" : "\\u2029";
      i += separator.size();
    } else {
      text += json[i];
    }
  }
  return text;
}

/// Puts `text` where the page has `marker`, and moves `rest` behind it.
void fill(std::string& page, std::string_view& rest, std::string_view marker,
          std::string_view text) {
  const std::size_t at = rest.find(marker);
  expects(at != std::string_view::npos, "viewer/report.html has its markers, in order");
  page += rest.substr(0, at);
  page += text;
  rest.remove_prefix(at + marker.size());
}

}  // namespace

Result<std::string> html_report(std::string_view record_json) {
  if (auto error = problem(record_json)) {
    return *std::move(error);
  }
  const std::string record = harmless(record_json);
  std::string page;
  page.reserve(page_html.size() + page_css.size() + page_js.size() + record.size());
  std::string_view rest = page_html;
  fill(page, rest, css_marker, page_css);
  fill(page, rest, record_marker, record);
  fill(page, rest, js_marker, page_js);
  page += rest;
  return page;
}

}  // namespace saca::report
