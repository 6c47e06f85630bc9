#include "editor/lsp/methods.h"

#include <map>
#include <utility>

namespace orb::editor {
namespace {

/// `root` is the document whose program it belongs to; later requests about it carry its URI.
Json callable(const Workspace& space, const std::string& uri, const Source& root,
              const Callable& one) {
  const auto& source = one.source != nullptr ? *one.source : root;
  Json json{{"name", one.name},
            {"kind", symbol_kind(OutlineKind::Function)},
            {"uri", one.source != nullptr ? space.uri_of(source) : uri},
            {"range", space.range(source, one.span)},
            {"selectionRange", space.range(source, one.selection)},
            {"data", {{"root", uri}, {"name", one.name}}}};
  if (!one.detail.empty())
    json["detail"] = one.detail;
  return json;
}

} // namespace

Answer callables(const Workspace& space, const Asked& asked) {
  const auto& [uri, document, params, at] = asked;
  if (document.shape().calls == nullptr)
    return Json();
  const auto all = document.shape().calls(document.source, space.options);
  std::optional<std::size_t> found;
  const auto take = [&](std::size_t index) { found = found ? found : std::optional(index); };
  for (const auto& call : all.calls)
    if (all.callables[call.caller].source == nullptr && touches(call.site, at))
      take(call.callee);
  for (std::size_t i = 0; i < all.callables.size(); ++i)
    if (all.callables[i].source == nullptr && touches(all.callables[i].selection, at))
      take(i);
  return found ? Json::array({callable(space, uri, document.source, all.callables[*found])})
               : Json();
}

Answer calls(const Workspace& space, const Json& params, Related wanted) {
  const bool incoming = wanted == Related::Callers;
  const auto& data = member(member(params, "item"), "data");
  const auto uri = text_of(member(data, "root"));
  const auto name = text_of(member(data, "name"));
  const auto found = space.documents().find(uri);
  if (found == space.documents().end() || found->second.shape().calls == nullptr)
    return refuse(RpcError::InvalidParams, "the item belongs to no open document");
  const auto& root = found->second.source;
  const auto all = found->second.shape().calls(root, space.options);
  std::map<std::size_t, Json> sites; // by the other callable
  for (const auto& call : all.calls) {
    const auto& caller = all.callables[call.caller];
    if (all.callables[incoming ? call.callee : call.caller].name != name)
      continue;
    auto& list = sites[incoming ? call.caller : call.callee];
    list.push_back(space.range(caller.source != nullptr ? *caller.source : root, call.site));
  }
  auto list = Json::array();
  for (const auto& [other, ranges] : sites)
    list.push_back({{incoming ? "from" : "to", callable(space, uri, root, all.callables[other])},
                    {"fromRanges", ranges}});
  return list;
}

} // namespace orb::editor
