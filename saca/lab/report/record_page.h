#pragma once

#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::report {

/// One HTML file that shows the record of an encounter: page, style, script and the record itself,
/// and nothing that it would have to load.
///
/// @param record_json  UTF-8 text of a record, schema `saca.record/1`: see docs/formats.md
/// @return             Error::Code::malformed when it is not JSON or names another schema
///
/// The record stands in the page as given, but for the characters that could end its element: no
/// text in a record becomes markup or script.
[[nodiscard]] Result<std::string> html_report(std::string_view record_json);

/// The same for the record of one manoeuvre, schema `saca.drive/1`.
[[nodiscard]] Result<std::string> drive_report(std::string_view record_json);

/// The same for a solved value, schema `saca.value_page/1` (`value_json`).
[[nodiscard]] Result<std::string> value_report(std::string_view record_json);

}  // namespace saca::report
