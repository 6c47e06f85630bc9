#include "editor/lsp/methods.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::editor {
namespace {

// CompletionItemKind of the protocol.
int kind_number(SuggestionKind kind) {
  switch (kind) {
  case SuggestionKind::Function: return 3;
  case SuggestionKind::Variable: return 6;
  case SuggestionKind::Value: return 12;
  case SuggestionKind::Keyword: return 14;
  case SuggestionKind::Line: return 18;
  case SuggestionKind::Rule: return 20;
  case SuggestionKind::Name: break;
  }
  return 5;
}

} // namespace

Answer hover(const Workspace& space, const Asked& asked) {
  const auto& [uri, document, params, at] = asked;
  const auto found = document.language->hover(document.source, at, space.surroundings());
  if (!found)
    return Json();
  return Json{{"contents", {{"kind", "markdown"}, {"value", found->markdown}}},
              {"range", space.range(document.source, found->span)}};
}

Answer completion(const Workspace& space, const Asked& asked) {
  const auto& [uri, document, params, at] = asked;
  const auto found = document.language->suggest(document.source, at, space.surroundings());
  const auto place = space.range(document.source, found.replaces);
  auto list = Json::array();
  for (std::size_t i = 0; i < found.items.size(); ++i) {
    const auto& item = found.items[i];
    Json json{{"label", item.label},
              {"kind", kind_number(item.kind)},
              {"sortText", fmt::format("{:04}", i)}, // the order of the tables suits readers
              {"textEdit", {{"range", place}, {"newText", item.label}}}};
    if (!item.detail.empty())
      json["detail"] = item.detail;
    if (!item.markdown.empty())
      json["documentation"] = {{"kind", "markdown"}, {"value", item.markdown}};
    list.push_back(std::move(json));
  }
  return Json{{"isIncomplete", false}, {"items", std::move(list)}};
}

Answer format(const Workspace& space, const Asked& asked) {
  const auto& document = asked.document;
  const auto text = document.language->format(document.source);
  return text ? space.replace_all(document.source, *text) : Json();
}

Answer hints(const Workspace& space, const Asked& asked) {
  const auto& document = asked.document;
  const auto& params = asked.params;
  const auto place = space.span(document.source, member(params, "range"));
  if (!place)
    return refuse(RpcError::InvalidParams, "a range has a start and an end");
  auto list = Json::array();
  if (document.language->hints == nullptr)
    return list;
  for (const auto& hint : document.language->hints(document.source, space.options))
    if (place->begin <= hint.at && hint.at <= place->end)
      list.push_back({{"position", space.position(document.source, hint.at)},
                      {"label", hint.label},
                      {"tooltip", hint.tooltip},
                      {"paddingLeft", !hint.label.starts_with(':')}});
  return list;
}

Answer code_actions(const Workspace& space, const Asked& asked) {
  const auto& uri = asked.uri;
  const auto& document = asked.document;
  const auto& params = asked.params;
  const auto place = space.span(document.source, member(params, "range"));
  if (!place)
    return refuse(RpcError::InvalidParams, "a range has a start and an end");
  const auto& only = member(member(params, "context"), "only");
  const auto wanted = [&](std::string_view kind) {
    if (!only.is_array())
      return true;
    return std::any_of(only.begin(), only.end(), [&](const Json& one) {
      const auto prefix = text_of(one);
      return kind == prefix ||
             (kind.starts_with(prefix) && kind.substr(prefix.size()).starts_with("."));
    });
  };
  auto list = Json::array();
  for (const auto& one : space.check(document)) {
    if (!one.fix)
      continue;
    if (!overlap(one.span, *place) || !wanted("quickfix"))
      continue;
    list.push_back({{"title", space.say(one.fix->title)},
                    {"kind", "quickfix"},
                    {"isPreferred", one.fix->safety == Safety::Safe},
                    {"diagnostics", Json::array({diagnostic(space, uri, document, one)})},
                    {"edit", workspace_edit(uri, space.edits(document.source, one.fix->edits))}});
  }
  constexpr std::size_t most = 65536; // bytes; larger than any robot's memory, and slow to check
  if (document.source.text().size() > most)
    return list;
  for (const auto& rewrite : document.language->rewrites(document.source, space.options))
    if (wanted(rewrite.kind))
      list.push_back(
          {{"title", rewrite.title},
           {"kind", rewrite.kind},
           {"edit", workspace_edit(uri, space.replace_all(document.source, rewrite.text))}});
  return list;
}

} // namespace orb::editor
