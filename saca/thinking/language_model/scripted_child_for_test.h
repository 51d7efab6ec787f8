#pragma once

#include <string>
#include <vector>

namespace saca::language_model {

// A model's process played by a shell script.
//   ready      the system part is read
//   first S    first answer, policy 4, for scene S
//   ended S    last answer, policy 0
//   says S N   last answer, policy N
//   done_
inline std::vector<std::string> scripted_child(const std::string& behaviour) {
  return {"/bin/sh", "-c", R"(
say() { printf '{"v":1,"event":%s}\n' "$1"; }
ready() { say '"ready","description":"fake","system_tokens":9,"load_s":0.5'; }
first() { say "\"answer\",\"id\":$id,\"scene\":$1,\"kind\":\"first\",\"probability\":[0,0,0,0,1,0,0,0]"; }
says() {
  list=$(for n in 0 1 2 3 4 5 6 7; do [ "$n" = "$2" ] && printf ',1' || printf ',0'; done)
  say "\"answer\",\"id\":$id,\"scene\":$1,\"kind\":\"ended\",\"probability\":[${list#,}]"
}
ended() { says "$1" 0; }
text() { say "\"text\",\"id\":$id,\"scene\":$1,\"text\":\"$2\""; }
done_() { say "\"done\",\"id\":$id,\"reply_tokens\":[3,4],\"prompt_s\":0.25,\"reply_s\":1,\"overran\":false"; }
ask() { read -r line && id=$(printf '%s' "$line" | sed 's/.*"id":\([0-9]*\).*/\1/'); }
read -r start
)" + behaviour};
}

}  // namespace saca::language_model
