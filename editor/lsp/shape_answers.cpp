#include "editor/lsp/methods.h"

#include "editor/lsp/shape_json.h"

namespace orb::editor {
Answer all_colors(const Workspace& space, const Asked& asked) {
  const auto& source = asked.document.source;
  return pack_colors(space, source, asked.document.shape().colors(source, space.options),
                     {0, static_cast<std::uint32_t>(source.text().size())});
}

Answer colors_within(const Workspace& space, const Asked& asked) {
  const auto& source = asked.document.source;
  const auto place = space.span(source, member(asked.params, "range"));
  if (!place)
    return refuse(RpcError::InvalidParams, "a range has a start and an end");
  return pack_colors(space, source, asked.document.shape().colors(source, space.options), *place);
}

Answer folds(const Workspace&, const Asked& asked) {
  return list_folds(asked.document.shape().folds(asked.document.source));
}

Answer selections(const Workspace& space, const Asked& asked) {
  const auto& source = asked.document.source;
  const auto& positions = member(asked.params, "positions");
  if (!positions.is_array())
    return refuse(RpcError::InvalidParams, "`positions` must be a list of positions");
  auto list = Json::array();
  for (const auto& one : positions) {
    const auto at = space.offset(source, one);
    if (!at)
      return refuse(RpcError::InvalidParams,
                    "a position is a line and a character, both counted from 0");
    list.push_back(nest_ranges(space, source,
                               nested(source, *at, asked.document.shape().around(source, *at))));
  }
  return list;
}

Answer signature(const Workspace& space, const Asked& asked) {
  const auto& document = asked.document;
  const auto found = document.shape().signature(document.source, asked.at, space.options);
  return found ? describe(*found) : Json();
}

Answer links(const Workspace& space, const Asked& asked) {
  const auto& document = asked.document;
  auto* const links = document.shape().links;
  return list_links(space, document.source,
                    links != nullptr ? links(document.source) : std::vector<Link>());
}

Answer lenses(const Workspace& space, const Asked& asked) {
  const auto& document = asked.document;
  auto* const lenses = document.shape().lenses;
  return list_lenses(space, asked.uri, document.source,
                     lenses != nullptr ? lenses(document.source) : std::vector<Lens>());
}

} // namespace orb::editor
