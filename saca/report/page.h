#pragma once

#include <string_view>

namespace saca::report {

// The files of viewer/, put into the library when it is built.

extern const std::string_view page_html;  ///< holds one marker each for style, record and script
extern const std::string_view page_css;
extern const std::string_view page_js;  ///< all scripts, in order

}  // namespace saca::report
