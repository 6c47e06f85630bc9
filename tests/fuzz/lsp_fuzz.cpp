// Feeds the language server any bytes: as a stream with headers, and as messages of an open
// session.

#include "editor/lsp/language_server.h"
#include "editor/wire.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

constexpr std::string_view opening[] = {
    R"({"id":0,"method":"initialize","params":{}})",
    R"({"method":"textDocument/didOpen","params":{"textDocument":{"uri":"a.bas","version":1,"text":"10 goto 10"}}})",
    R"({"method":"textDocument/didOpen","params":{"textDocument":{"uri":"a.macro","version":1,"text":"roll 1 2"}}})",
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  orb::editor::LanguageServer server;
  for (const auto message : opening)
    server.receive(message);
  orb::editor::MessageReader reader;
  reader.feed(text);
  while (const auto event = reader.next())
    event->is_error ? server.receive_garbage(event->text) : server.receive(event->text);
  while (!text.empty()) { // one message per line: most inputs have no header
    const auto end = text.find('\n');
    server.receive(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return 0;
}
