#pragma once

#include <string_view>

namespace saca::report {

/// A page of viewer/, put into the library when it is built.
struct Page {
  std::string_view html;  ///< holds one marker each for style, record and script
  std::string_view css;   ///< all styles, in order
  std::string_view js;    ///< all scripts, in order
};

extern const Page encounter_page;  ///< shows schema `saca.record/1`
extern const Page drive_page;      ///< shows schema `saca.drive/1`
extern const Page value_page;      ///< shows schema `saca.value_page/1`

}  // namespace saca::report
