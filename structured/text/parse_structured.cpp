#include "structured/text/parse_structured.h"

#include "base/text/utf8.h"
#include "structured/text/lines.h"
#include "structured/text/link_blocks.h"

#include <algorithm>
#include <utility>

namespace orb::structured {

void parse(Program& program, std::string name, std::string path, std::string_view text) {
  File file;
  file.name = std::move(name);
  file.path = std::move(path);
  file.begin = static_cast<std::uint32_t>(program.text.size());
  program.text.append(text.substr(0, text.find('\0')));
  file.end = static_cast<std::uint32_t>(program.text.size());
  program.text += '\n'; // so that the end of the text has a place
  file.statements_begin = static_cast<std::uint32_t>(program.statements.size());
  program.statements.reserve(program.statements.size() + text.size() / 16);
  program.items.reserve(program.items.size() + text.size() / 12);
  program.nodes.reserve(program.nodes.size() + text.size() / 6);
  const auto* const begin = program.text.data() + file.begin;
  Lines(program, begin + byte_order_mark_size(text), program.text.data() + file.end).parse();
  file.statements_end = static_cast<std::uint32_t>(program.statements.size());
  link_blocks(program, file);
  program.files.push_back(std::move(file));
}

const File& Program::file_at(std::uint32_t offset) const {
  const auto next =
      std::upper_bound(files.begin(), files.end(), offset,
                       [](std::uint32_t at, const File& file) { return at < file.begin; });
  return next == files.begin() ? files.front() : *std::prev(next);
}

} // namespace orb::structured
