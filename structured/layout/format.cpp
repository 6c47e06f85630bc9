#include "structured/layout/format.h"

#include "base/text/utf8.h"
#include "structured/layout/layout.h"
#include "structured/text/parse_structured.h"

namespace orb::structured {

std::string format(std::string_view text) {
  Program program;
  parse(program, "", "", text.substr(byte_order_mark_size(text)));
  std::string out;
  for (const auto& line : lay_out(program)) {
    if (line.after_blank)
      out += '\n';
    out.append(2 * line.level, ' ');
    out += line.text;
    out += '\n';
  }
  return out;
}

} // namespace orb::structured
