#include "saca/lab/recordings/xml_reading.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "saca/base/core/csv.h"

namespace saca::recordings {
namespace {

using pugi::xml_node;

std::string_view without_space(std::string_view text) {
  constexpr std::string_view space = " \t\r\n";
  const std::size_t first = text.find_first_not_of(space);
  return first == std::string_view::npos
             ? std::string_view{}
             : text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string short_decimal(double value) {
  std::array<char, 32> digits{};
  const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

/// Tells an element from its equals: "[@id=7]", "[3]", or nothing.
std::string index_of(xml_node node) {
  if (const pugi::xml_attribute id = node.attribute("id")) {
    return "[@id=" + std::string(id.value()) + "]";
  }
  if (!node.next_sibling(node.name()) && !node.previous_sibling(node.name())) {
    return "";
  }
  std::size_t index = 1;
  for (xml_node before = node; (before = before.previous_sibling(node.name()));) {
    ++index;
  }
  return "[" + std::to_string(index) + "]";
}

std::string path_of(xml_node node) {
  constexpr int deepest = 12;  // of what is shown
  std::string path;
  for (int depth = 0; depth < deepest && node.type() == pugi::node_element; ++depth) {
    path.insert(0, index_of(node)).insert(0, node.name()).insert(0, "/");
    node = node.parent();
  }
  return path;
}

}  // namespace

std::string shown_text(std::string_view text) {
  constexpr std::size_t most = 40;
  return "`" + std::string(without_space(text).substr(0, most)) + "`";
}

std::optional<std::size_t> first_fault_of_utf8(std::string_view text) {
  // Of a sequence of 2, 3 and 4 bytes: marks of the first byte, and the least code it may hold.
  constexpr std::array<unsigned, 3> marks{0xC0, 0xE0, 0xF0};
  constexpr std::array<unsigned, 3> least{0x80, 0x800, 0x10000};
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t more = first < 0x80 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    if (more == 0) {
      ++i;
      continue;
    }
    if (first < 0xC0 || first > 0xF7 || i + more >= text.size()) {
      return i;
    }
    unsigned code = first - marks[more - 1];
    for (std::size_t k = 1; k <= more; ++k) {
      const unsigned next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xC0U) != 0x80) {
        return i;
      }
      code = code * 64 + (next & 0x3FU);
    }
    if (code < least[more - 1] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) {
      return i;
    }
    i += more + 1;
  }
  return std::nullopt;
}

void XmlReading::fail(xml_node place, const std::string& wanted_and_got, Error::Code code) {
  if (!problem_) {
    problem_ = error_at(place.offset_debug(), path_of(place) + ": " + wanted_and_got, code);
  }
}

Error XmlReading::error_at(std::ptrdiff_t offset, const std::string& message,
                           Error::Code code) const {
  const auto end = std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text_));
  const auto line = 1 + std::count(text_.begin(), text_.begin() + end, '\n');
  return {code, std::string(source_) + ":" + std::to_string(line) + ": " + message};
}

void XmlReading::ignore(xml_node node, std::string_view note) {
  ++ignored_[std::string(node.parent().name()) + "/" + node.name() + std::string(note)];
}

void XmlReading::ignore_but(xml_node parent, std::initializer_list<std::string_view> known) {
  for (const xml_node child : parent.children()) {
    if (child.type() == pugi::node_element &&
        std::find(known.begin(), known.end(), child.name()) == known.end()) {
      ignore(child);
    }
  }
}

xml_node XmlReading::element(xml_node parent, const char* name) {
  const xml_node child = parent.child(name);
  if (!child) {
    fail(parent, "want an element <" + std::string(name) + ">, got none");
  }
  return child;
}

double XmlReading::number(xml_node node, double least, double most) {
  const std::optional<double> value = finite_number(without_space(node.child_value()));
  if (!value) {
    fail(node, "want a number, got " + shown_text(node.child_value()));
    return 0.0;
  }
  if (*value < least || *value > most) {
    fail(node,
         "want " + short_decimal(least) + " to " + short_decimal(most) + ", got " +
             shown_text(node.child_value()),
         Error::Code::out_of_range);
    return 0.0;
  }
  return *value;
}

double XmlReading::inner(xml_node parent, const char* name, double least, double most) {
  const xml_node child = element(parent, name);
  return child ? number(child, least, most) : 0.0;
}

double XmlReading::exact(xml_node parent, const char* name, double least, double most) {
  const xml_node child = element(parent, name);
  if (!child || child.child("exact")) {
    return child ? inner(child, "exact", least, most) : 0.0;
  }
  fail(child, "want <exact>, got <" + std::string(child.first_child().name()) +
                  ">: intervals are predictions, not recordings");
  return 0.0;
}

std::string XmlReading::text(xml_node node, const char* attribute) {
  std::string value = node.attribute(attribute).value();
  if (first_fault_of_utf8(value)) {  // a reference to a character may make one
    fail(node, "attribute " + std::string(attribute) + ": want UTF-8");
    return "";
  }
  return value;
}

std::int64_t XmlReading::id(xml_node node, const char* attribute) {
  const char* const text = node.attribute(attribute).value();
  const std::optional<double> value = finite_number(text);
  constexpr double most = 1e15;
  if (!value || std::abs(*value) > most || *value != std::floor(*value)) {
    fail(node,
         "attribute " + std::string(attribute) + ": want a whole number, got " + shown_text(text));
    return 0;
  }
  return static_cast<std::int64_t>(*value);
}

}  // namespace saca::recordings
