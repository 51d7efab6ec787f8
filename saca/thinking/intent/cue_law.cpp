#include "saca/thinking/intent/cue_law.h"

#include <fmt/core.h>

#include <string>

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"

namespace saca::intent {
namespace {

using config::Table;
using world::ActorKind;

constexpr std::string_view schema = "saca.cues/1";
constexpr std::string_view slippery = "slippery";

Unseen read_unseen(Table table) {
  Unseen unseen;
  const std::string what = table.text("unseen");
  unseen.who = world::actor_kind_from(what);
  if (unseen.who == ActorKind::obstacle || (!unseen.who && what != slippery)) {
    table.reject(
        "unseen",
        "want car, van, truck, motorcycle, bicycle, pedestrian or slippery, got \"" + what + "\"");
  }
  unseen.probability = table.number("probability", {0.0, 1.0});
  if (unseen.who) {
    unseen.speed = table.number("speed_mps", {0.1, 40.0});
  } else {
    unseen.grip_share = table.number("grip_share", {0.1, 1.0});
  }
  if (table.text("source").empty()) {
    table.reject("source", "want who says so, or \"assumption: ...\", got nothing");
  }
  return unseen;
}

}  // namespace

Result<CueLaw> read_cue_law(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  Table root = document.value().root();
  root.want_schema(schema);
  CueLaw law;
  for (Table table : root.tables("cues")) {
    const std::string word = table.text("kind");
    const auto kind = world::cue_kind_from(word);
    if (!kind) {
      table.reject("kind", fmt::format("want {}, got \"{}\"", world::cue_kind_words, word));
      break;
    }
    auto& unseen = law.unseen[static_cast<std::size_t>(*kind)];
    if (unseen) {
      table.reject("kind", "want each kind once, got a second " + word);
    }
    unseen = read_unseen(table);
  }
  if (auto error = document.value().error()) {
    return *error;
  }
  return law;
}

std::string cue_law_text(const CueLaw& law,
                         const std::array<std::string, world::num_cue_kinds>& sources) {
  std::string text = fmt::format("schema = \"{}\"\n", schema);
  for (std::size_t k = 0; k < law.unseen.size(); ++k) {
    const auto& unseen = law.unseen.at(k);
    if (!unseen) {
      continue;
    }
    text += fmt::format("\n[[cues]]\nkind = \"{}\"\nunseen = \"{}\"\nprobability = {}\n",
                        name(static_cast<world::CueKind>(k)),
                        unseen->who ? world::name(*unseen->who) : slippery, unseen->probability);
    text += unseen->who ? fmt::format("speed_mps = {}\n", unseen->speed)
                        : fmt::format("grip_share = {}\n", unseen->grip_share);
    text += fmt::format("source = \"{}\"\n", sources.at(k));
  }
  return text;
}

std::uint64_t digest(const CueLaw& law) {
  Fnv hash;
  for (const auto& unseen : law.unseen) {
    hash.add(unseen ? 1 : 0);
    if (unseen) {
      hash.add(unseen->who ? 1 + static_cast<std::uint64_t>(*unseen->who) : 0);
      hash.add_doubles(std::array{unseen->probability, unseen->speed, unseen->grip_share});
    }
  }
  return hash.value();
}

Result<CueLaw> load_cue_law(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return read_cue_law(text.value(), path.string());
}

}  // namespace saca::intent
