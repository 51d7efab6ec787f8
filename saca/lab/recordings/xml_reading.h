#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::recordings {

/// One pass over an XML file: what went wrong first, and what was passed over.
///
/// Messages name source, line, element, wanted and got:
/// `a.xml:12: /commonRoad/lanelet[@id=7]/leftBound/point[3]/x: want a number, got `west``.
class XmlReading {
 public:
  /// Both outlive it; nodes must come from a document that was parsed from `text`.
  XmlReading(std::string_view text, std::string_view source) : text_(text), source_(source) {}

  /// Remembers the first problem only: later ones often follow from it.
  void fail(pugi::xml_node place, const std::string& wanted_and_got,
            Error::Code code = Error::Code::malformed);
  [[nodiscard]] const std::optional<Error>& problem() const { return problem_; }
  /// @param offset  into the text [bytes]
  [[nodiscard]] Error error_at(std::ptrdiff_t offset, const std::string& message,
                               Error::Code code = Error::Code::malformed) const;

  /// Counts a node that is passed over, by `parent/element` and the note.
  void ignore(pugi::xml_node node, std::string_view note = "");
  /// Counts the elements within `parent` that nobody reads.
  void ignore_but(pugi::xml_node parent, std::initializer_list<std::string_view> known);
  [[nodiscard]] const std::map<std::string, std::size_t>& ignored() const { return ignored_; }

  // What is missing, no number or out of its bounds is a problem, and 0 or no node comes back.

  pugi::xml_node element(pugi::xml_node parent, const char* name);
  double number(pugi::xml_node node, double least, double most);
  /// The number in an element within `parent`.
  double inner(pugi::xml_node parent, const char* name, double least, double most);
  /// The number in <exact> in an element within `parent`; an interval is a problem.
  double exact(pugi::xml_node parent, const char* name, double least, double most);
  /// Text in an attribute; what is no UTF-8 is a problem.
  std::string text(pugi::xml_node node, const char* attribute);
  /// A whole number in an attribute.
  std::int64_t id(pugi::xml_node node, const char* attribute);

 private:
  std::string_view text_;
  std::string_view source_;
  std::optional<Error> problem_;
  std::map<std::string, std::size_t> ignored_;
};

/// A file's own words for a message: the beginning, in marks.
[[nodiscard]] std::string shown_text(std::string_view text);

/// Where the first byte stands that is not part of UTF-8 as Unicode allows it.
[[nodiscard]] std::optional<std::size_t> first_fault_of_utf8(std::string_view text);

}  // namespace saca::recordings
