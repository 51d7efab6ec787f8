#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "saca/thinking/language_model/chat_stream.h"
#include "saca/thinking/language_model/example_situation.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/protocol.h"
#include "saca/thinking/language_model/replay_model.h"
#include "saca/thinking/language_model/reply.h"
#include "saca/thinking/language_model/truth.h"

namespace {

namespace language_model = saca::language_model;

void require(bool promise) {
  if (!promise) {
    __builtin_trap();
  }
}

/// In pieces of a size, as a connection may deliver it; nullopt: refused.
std::optional<std::string> streamed(std::string_view bytes, std::size_t piece) {
  language_model::ChatStream stream;
  std::string text;
  for (std::size_t from = 0; from < bytes.size(); from += piece) {
    const auto more = stream.take(bytes.substr(from, piece));
    if (!more.has_value()) {
      require(!more.error().message.empty() && more.error().message.size() < 2'000);
      return std::nullopt;
    }
    text += more.value();
  }
  require(text == stream.text());
  return text;
}

}  // namespace

// Whatever a model, a server or a file says: it is read or refused with a message, wherever the
// bytes are cut, and only 0 to 7 can be an answer. A broken promise traps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);

  const auto whole = streamed(text, size + 1);
  const auto cut = streamed(text, 7);
  require(whole.has_value() == cut.has_value() && (!whole || *whole == *cut));

  for (const auto& stated :
       {language_model::stated_policy(text), language_model::stated_so_far(text)}) {
    require(!stated || saca::manoeuvre::index(*stated) < saca::manoeuvre::num_policies);
  }

  static const auto situation = language_model::example_situation();
  static const std::string prompt = language_model::scene_part(situation, std::nullopt, 0.0);
  const language_model::Truth truth =
      language_model::truth_of(text, prompt, situation, saca::manoeuvre::PolicyId::aes_left);
  require(truth.wrong.size() <= static_cast<std::size_t>(truth.num_checked));
  for (const language_model::FalseStatement& each : truth.wrong) {
    require(!each.why.empty() && each.text.size() <= 210);
  }

  const auto event = language_model::protocol::event_from(text);
  if (event.has_value()) {  // what was understood is said again in the same words
    const std::string line = language_model::protocol::line(event.value());
    require(language_model::protocol::line(language_model::protocol::event_from(line).value()) ==
            line);
  }
  const auto replies = language_model::parse_replies(text, "fuzz.json");
  require(replies.has_value() || replies.error().message.rfind("fuzz.json: ", 0) == 0);
  return 0;
}
