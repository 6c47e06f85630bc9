#include "editor/lsp/methods.h"

#include "editor/lsp/shape_json.h"

#include <utility>

namespace orb::editor {
namespace {

enum class Shown : std::uint8_t { Definitions, Uses, All };
Json locations(const Workspace& space, const Asked& asked, const Occurrences& names, Shown shown) {
  auto list = Json::array();
  auto places = space.ruler(asked.document.source);
  const auto add = [&](bool wanted, const std::vector<Span>& spans) {
    if (wanted)
      for (const auto span : spans)
        list.push_back({{"uri", asked.uri}, {"range", space.range(places, span)}});
  };
  add(shown != Shown::Uses, names.definitions);
  add(shown != Shown::Definitions, names.uses);
  for (const auto& place : names.elsewhere)
    if (shown != (place.defines ? Shown::Uses : Shown::Definitions))
      list.push_back({{"uri", space.uri_of(*place.source)},
                      {"range", space.range(*place.source, place.span)}});
  return list;
}

} // namespace

Answer definition(const Workspace& space, const Asked& asked) {
  const auto& source = asked.document.source;
  return locations(space, asked,
                   asked.document.language->occurrences(source, asked.at, space.surroundings()),
                   Shown::Definitions);
}

Answer references(const Workspace& space, const Asked& asked) {
  const auto& source = asked.document.source;
  const auto& declared = member(member(asked.params, "context"), "includeDeclaration");
  const auto closed = space.closed_programs(asked.document);
  const auto all = space.surroundings(closed);
  return locations(space, asked, asked.document.language->occurrences(source, asked.at, all),
                   !declared.is_boolean() || declared.get<bool>() ? Shown::All : Shown::Uses);
}

Answer highlight(const Workspace& space, const Asked& asked) {
  const auto& document = asked.document;
  constexpr int read = 2;
  constexpr int write = 3;
  const auto names =
      document.language->occurrences(document.source, asked.at, space.surroundings());
  auto list = Json::array();
  auto places = space.ruler(document.source);
  for (const auto span : names.definitions)
    list.push_back({{"range", space.range(places, span)}, {"kind", write}});
  for (const auto span : names.uses)
    list.push_back({{"range", space.range(places, span)}, {"kind", read}});
  return list;
}

Answer prepare_rename(const Workspace& space, const Asked& asked) {
  const auto& document = asked.document;
  const auto at = asked.at;
  const auto names = document.language->occurrences(document.source, at, space.surroundings());
  for (const auto* spans : {&names.definitions, &names.uses})
    for (const auto span : *spans)
      if (span.begin <= at && at <= span.end)
        return Json{{"range", space.range(document.source, span)},
                    {"placeholder", document.source.text(span)}};
  return Json();
}

Answer rename(const Workspace& space, const Asked& asked) {
  const auto& [uri, document, params, at] = asked;
  const auto name = text_of(member(params, "newName"));
  const auto closed = space.closed_programs(document);
  const auto renaming =
      document.language->rename(document.source, at, name, space.surroundings(closed));
  if (!renaming)
    return refuse(RpcError::RequestFailed, renaming.error());
  auto changed = workspace_edit(uri, space.edits(document.source, renaming->edits));
  for (const auto& place : renaming->elsewhere)
    changed["changes"][space.uri_of(*place.source)].push_back(
        space.edit(*place.source, {place.span, name}));
  return changed;
}

Answer symbols(const Workspace& space, const Asked& asked) {
  const auto& document = asked.document;
  auto list = Json::array();
  for (const auto& symbol : document.language->outline(document.source))
    list.push_back({{"name", symbol.name.empty() ? "?" : symbol.name},
                    {"detail", symbol.detail},
                    {"kind", symbol_kind(symbol.kind)},
                    {"range", space.range(document.source, symbol.span)},
                    {"selectionRange", space.range(document.source, symbol.selection)}});
  return list;
}

Answer workspace_symbols(const Workspace& space, const std::string& query) {
  constexpr std::size_t most = 500;
  auto list = Json::array();
  const auto add = [&](const std::string& uri, const Source& source,
                       const LanguageService& language) {
    for (const auto& symbol : language.outline(source))
      if (answers_to(symbol.name, query) && list.size() < most)
        list.push_back(
            {{"name", symbol.name},
             {"kind", symbol_kind(symbol.kind)},
             {"containerName", symbol.detail},
             {"location", {{"uri", uri}, {"range", space.range(source, symbol.selection)}}}});
  };
  for (const auto& [uri, document] : space.documents())
    add(uri, document.source, *document.language);
  space.each_closed_file([&](const std::string& path, std::string text) {
    const auto uri = uri_of_path(path);
    add(uri, Source(uri, std::move(text)), language_of("", uri));
  });
  return list;
}

} // namespace orb::editor
