#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/vec2.h"

namespace saca::report {

/// An element of an XML document, for tests.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< directly in it, entities resolved
  int depth = 0;
};

/// Reads XML strictly: what is left open, unquoted, doubled or unescaped is refused.
class XmlReader {
 public:
  /// @throws std::runtime_error  if the document is not well-formed
  explicit XmlReader(std::string_view text) : rest_(text) {
    do {
      read_one();
    } while (!open_.empty());
    want(rest_.find_first_not_of(" \n") == std::string_view::npos, "nothing after the root");
  }
  [[nodiscard]] const std::vector<XmlElement>& elements() const { return elements_; }

 private:
  static void want(bool holds, const char* what) {
    if (!holds) {
      throw std::runtime_error(std::string("XML: want ") + what);
    }
  }

  std::string_view take(std::size_t size) {
    want(size <= rest_.size(), "more text");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  std::string_view until(std::string_view stops) {
    const std::size_t at = rest_.find_first_of(stops);
    want(at != std::string_view::npos, "an end");
    return take(at);
  }

  static std::string resolved(std::string_view raw) {
    static const std::map<std::string_view, char> entities{
        {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"#39", '\''}};
    std::string out;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i] == '&') {
        const std::size_t end = raw.find(';', i);
        want(end != std::string_view::npos, "; after &");
        const auto found = entities.find(raw.substr(i + 1, end - i - 1));
        want(found != entities.end(), "a known entity");
        out += found->second;
        i = end;
      } else {
        want(static_cast<unsigned char>(raw[i]) >= 0x20 || raw[i] == '\n', "no control character");
        out += raw[i];
      }
    }
    return out;
  }

  void read_one() {
    const std::string_view text = until("<");
    if (open_.empty()) {
      want(text.empty(), "no text outside the root");
    } else {
      elements_[open_.back()].text += resolved(text);
    }
    take(1);
    if (!rest_.empty() && rest_.front() == '/') {
      take(1);
      want(!open_.empty() && elements_[open_.back()].name == until(">"), "tags closed in order");
      take(1);
      open_.pop_back();
    } else {
      read_start();
    }
  }

  void read_start() {
    XmlElement element;
    element.name = until(" />");
    element.depth = static_cast<int>(open_.size());
    want(!element.name.empty(), "a name");
    while (rest_.front() == ' ') {
      take(1);
      const std::string key(until("="));
      take(1);
      want(take(1) == "\"", "a quoted value");
      const std::string_view raw = until("\"<");
      want(take(1) == "\"", "no < in a value");
      want(element.attributes.emplace(key, resolved(raw)).second, "each attribute once");
    }
    const bool closed = rest_.front() == '/';
    take(closed ? 1 : 0);
    want(take(1) == ">", ">");
    elements_.push_back(std::move(element));
    if (!closed) {
      open_.push_back(elements_.size() - 1);
    }
  }

  std::string_view rest_;
  std::vector<XmlElement> elements_;
  std::vector<std::size_t> open_;
};

/// All elements of a document, in order.
inline std::vector<XmlElement> xml_elements(std::string_view text) {
  return XmlReader(text).elements();
}

/// Those with this name whose class is `classes`, word for word.
inline std::vector<XmlElement> with_class(const std::vector<XmlElement>& all, std::string_view name,
                                          std::string_view classes) {
  std::vector<XmlElement> found;
  for (const XmlElement& element : all) {
    const auto has = element.attributes.find("class");
    if (element.name == name && has != element.attributes.end() && has->second == classes) {
      found.push_back(element);
    }
  }
  return found;
}

inline double xml_number(const XmlElement& element, const std::string& key) {
  return std::stod(element.attributes.at(key));
}

/// The corners of a polygon or polyline [px].
inline std::vector<Vec2> xml_points(const XmlElement& element) {
  std::vector<Vec2> points;
  const std::string& text = element.attributes.at("points");
  for (std::size_t i = 0; i < text.size();) {
    std::size_t used = 0;
    Vec2 p;
    p.x = std::stod(text.substr(i), &used);
    i += used + 1;  // the comma
    p.y = std::stod(text.substr(i), &used);
    i += used + 1;  // the space
    points.push_back(p);
  }
  return points;
}

/// Is there a text that says just this?
inline bool says(const std::vector<XmlElement>& all, std::string_view words) {
  for (const XmlElement& element : all) {
    if (element.name == "text" && element.text == words) {
      return true;
    }
  }
  return false;
}

}  // namespace saca::report
