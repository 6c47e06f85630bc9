#include "report/reload.h"

#include "base/hash.h"

#include <cstdint>
#include <fmt/format.h>
#include <string_view>

namespace orb::report {
namespace {

/// The script goes before this tag and after the encoding, which browsers want to read first.
constexpr std::string_view head_mark = "<meta name=\"viewport\"";

/// A page opened from a folder may not read files, but it may load one in a frame, which reports
/// its stamp. The query string keeps browsers from refusing a page inside itself.
constexpr std::string_view script = R"(<script>
"use strict";
(() => {{
  const stamp = "{:016x}";
  if (parent !== window) {{
    parent.postMessage({{ orb_stamp: stamp }}, "*");
    stop();
    return;
  }}
  let frame = null;
  addEventListener("message", message => {{
    const seen = message.data && message.data.orb_stamp;
    if (frame && message.source === frame.contentWindow && seen && seen !== stamp) location.reload();
  }});
  setInterval(() => {{
    if (document.hidden) return;
    if (frame) frame.remove();
    frame = document.createElement("iframe");
    frame.hidden = true;
    frame.src = location.pathname + "?" + Date.now();
    document.body.append(frame);
  }}, 1000);
}})();
</script>
)";

} // namespace

std::string reloading(std::string page) {
  const auto stamp = hash(page);
  return page.insert(page.find(head_mark), fmt::format(script, stamp));
}

} // namespace orb::report
