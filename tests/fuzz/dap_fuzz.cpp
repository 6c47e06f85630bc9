// Feeds the debug adapter any bytes: as a stream with headers, and as requests of an open session
// whose program runs in between.

#include "editor/dap/debug_adapter.h"
#include "editor/wire.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

constexpr std::string_view opening[] = {
    R"({"seq":1,"type":"request","command":"initialize"})",
    R"({"seq":2,"type":"request","command":"launch","arguments":{"program":"p.orb","stopOnEntry":true}})",
    R"({"seq":3,"type":"request","command":"configurationDone"})",
};

class OneProgram final : public orb::structured::Files {
public:
  std::optional<std::string> read(const std::string& path) override {
    if (path != "p.orb")
      return std::nullopt;
    return "array seen[3]\nsub turn(by)\n  n += 1\n  goroll by, 90, 1\n  delay 20ms\nend sub\n"
           "loop\n  turn(90)\n  seen[1] = xpos\n  if n > 9 then n = 5 / (n - 10)\nend loop\n";
  }
};

/// Lets the program run for a short while.
void work(orb::editor::DebugAdapter& adapter) {
  int looks = 0;
  if (adapter.busy())
    adapter.work([&] { return ++looks > 1; });
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  OneProgram files;
  orb::editor::DebugAdapter adapter(files, "");
  for (const auto message : opening)
    adapter.receive(message);
  orb::editor::MessageReader reader;
  reader.feed(text);
  while (const auto event = reader.next()) {
    event->is_error ? adapter.receive_garbage(event->text) : adapter.receive(event->text);
    work(adapter);
  }
  while (!text.empty()) { // one message per line: most inputs have no header
    const auto end = text.find('\n');
    adapter.receive(text.substr(0, end));
    work(adapter);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return 0;
}
