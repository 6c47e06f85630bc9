#include "base/text/header_fields.h"

#include "base/text/text.h"

#include <algorithm>

namespace orb {

BodyLength body_length(std::string_view header) {
  BodyLength length;
  while (!header.empty()) {
    const auto end = std::min(header.find_first_of("\r\n"), header.size());
    const auto line = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    const auto colon = line.find(':');
    if (colon == std::string_view::npos ||
        !equal_words(trim(line.substr(0, colon)), "Content-Length"))
      continue;
    const auto bytes = parse_number<std::size_t>(trim(line.substr(colon + 1)));
    if (!bytes || (length.said == BodyLength::Found::Length && length.bytes != *bytes))
      return {BodyLength::Found::Nonsense, 0};
    length = {BodyLength::Found::Length, *bytes};
  }
  return length;
}

} // namespace orb
