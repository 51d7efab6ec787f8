#include "saca/thinking/language_model/chat_address.h"

#include <algorithm>
#include <array>

#include "saca/thinking/language_model/curl_handle.h"
#include "saca/thinking/language_model/quote.h"

namespace saca::language_model {
namespace {

constexpr std::string_view scheme_end = "://";

// Where user, host and port stand in a URL.
struct Authority {
  std::size_t begin = 0;
  std::size_t size = 0;
};
Authority authority(std::string_view url) {
  const std::size_t scheme = url.find(scheme_end);
  const std::size_t begin = scheme == std::string_view::npos ? 0 : scheme + scheme_end.size();
  const std::size_t end = std::min(url.find_first_of("/?#", begin), url.size());
  return {.begin = begin, .size = end - begin};
}

std::string part(CURLU* url, CURLUPart which) {
  char* text = nullptr;
  (void)curl_url_get(url, which, &text, 0);
  const CurlText owner(text);
  return text == nullptr ? std::string() : std::string(text);
}

bool is_this_machine(std::string_view host) {
  constexpr std::array<std::string_view, 3> names{"127.0.0.1", "[::1]", "localhost"};
  return std::find(names.begin(), names.end(), host) != names.end();
}

}  // namespace

std::string shown_address(std::string_view base) {
  std::string shown(base);
  const auto [begin, size] = authority(base);
  // The last one anywhere: where a URL is broken a password may hold what ends this part.
  const bool scheme = base.find(scheme_end) != std::string_view::npos;
  const std::string_view rest = base.substr(begin);
  const std::size_t at = scheme ? rest.substr(0, size).rfind('@') : rest.rfind('@');
  if (at != std::string_view::npos) {
    shown.replace(begin, at, "***");
  }
  return quote(shown, "");
}

Result<std::string> chat_address(std::string_view base, bool with_key) {
  const auto refuse = [&](const std::string& want) {
    return Error{Error::Code::malformed,
                 "URL of the model: want " + want + ", got " + shown_address(base)};
  };
  const bool plain =
      std::all_of(base.begin(), base.end(), [](char c) { return c > ' ' && c < 0x7F; });
  if (!plain) {
    return refuse("neither spaces nor control characters nor letters beyond ASCII");
  }
  if (!base.starts_with("http://") && !base.starts_with("https://")) {
    return refuse("http:// or https://");
  }
  const auto [begin, size] = authority(base);
  if (base.substr(begin, size).find('@') != std::string_view::npos) {
    return refuse("no user and no password in it");
  }
  if (base.find_first_of("?#") != std::string_view::npos) {
    return refuse("neither query nor fragment");
  }
  const CurlUrl url(curl_url());
  const CURLUcode code = url ? curl_url_set(url.get(), CURLUPART_URL, std::string(base).c_str(), 0)
                             : CURLUE_OUT_OF_MEMORY;
  if (code != CURLUE_OK) {
    return refuse(std::string("http(s)://host[:port][/path] (") + curl_url_strerror(code) + ")");
  }
  // Asked of the reader that curl itself will use, so that both see one host.
  if (with_key && part(url.get(), CURLUPART_SCHEME) != "https" &&
      !is_this_machine(part(url.get(), CURLUPART_HOST))) {
    return refuse("https, or this machine (127.0.0.1, ::1, localhost), where a key goes along");
  }
  std::string address = part(url.get(), CURLUPART_URL);
  while (address.ends_with('/')) {
    address.pop_back();
  }
  return address + "/chat/completions";
}

}  // namespace saca::language_model
