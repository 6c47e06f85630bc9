#include "editor/lsp/shape_json.h"

#include "base/text/text.h"

namespace orb::editor {
namespace {

struct DeedInfo {
  std::string_view title;
  std::string_view command;
};

DeedInfo info(Lens::Deed deed) {
  switch (deed) {
  case Lens::Deed::Run: return {"run", "orb.run"};
  case Lens::Deed::Debug: return {"debug", "orb.debug"};
  case Lens::Deed::RunTest: return {"run test", "orb.runTest"};
  case Lens::Deed::DebugTest: break;
  }
  return {"debug test", "orb.debugTest"};
}

} // namespace

Json shape_capabilities() {
  return {{"semanticTokensProvider",
           {{"legend", {{"tokenTypes", color_names}, {"tokenModifiers", trait_names}}},
            {"full", true},
            {"range", true}}},
          {"foldingRangeProvider", true},
          {"selectionRangeProvider", true},
          {"signatureHelpProvider", {{"triggerCharacters", {" ", "(", ","}}}},
          {"documentLinkProvider", Json::object()},
          {"codeLensProvider", Json::object()},
          {"callHierarchyProvider", true},
          {"workspaceSymbolProvider", true}};
}

Json pack_colors(const Wording& words, const Source& source, const std::vector<Colored>& colors,
                 Span within) {
  auto data = Json::array();
  auto places = words.ruler(source);
  TextPosition last;
  for (const auto& one : colors) {
    if (one.span.end < within.begin || within.end < one.span.begin)
      continue;
    const auto begin = places(one.span.begin);
    const auto end = places(one.span.end);
    if (end.line != begin.line || end.character <= begin.character)
      continue;
    const bool same_line = begin.line == last.line;
    data.push_back(begin.line - last.line);
    data.push_back(same_line ? begin.character - last.character : begin.character);
    data.push_back(end.character - begin.character);
    data.push_back(static_cast<int>(one.color));
    data.push_back(one.traits);
    last = begin;
  }
  return {{"data", std::move(data)}};
}

Json list_folds(const std::vector<Fold>& folds) {
  auto list = Json::array();
  for (const auto& fold : folds) {
    Json one{{"startLine", fold.first - 1}, {"endLine", fold.last - 1}};
    if (fold.is_comment)
      one["kind"] = "comment";
    list.push_back(std::move(one));
  }
  return list;
}

Json nest_ranges(const Wording& words, const Source& source, const std::vector<Span>& chain) {
  Json outer;
  for (auto span = chain.rbegin(); span != chain.rend(); ++span) {
    Json one{{"range", words.range(source, *span)}};
    if (!outer.is_null())
      one["parent"] = std::move(outer);
    outer = std::move(one);
  }
  return outer;
}

Json describe(const Signature& signature) {
  auto parameters = Json::array();
  for (const auto& one : signature.parameters) {
    // Labels are ASCII, so bytes count the same in every encoding.
    Json json{{"label", {one.in_label.begin, one.in_label.end}}};
    if (!one.text.empty())
      json["documentation"] = one.text;
    parameters.push_back(std::move(json));
  }
  Json made{{"label", signature.label}, {"parameters", std::move(parameters)}};
  if (!signature.markdown.empty())
    made["documentation"] = {{"kind", "markdown"}, {"value", signature.markdown}};
  return {{"signatures", Json::array({std::move(made)})},
          {"activeSignature", 0},
          {"activeParameter", signature.active}};
}

Json list_links(const Wording& words, const Source& source, const std::vector<Link>& links) {
  auto list = Json::array();
  for (const auto& link : links)
    list.push_back({{"range", words.range(source, link.span)}, {"target", uri_of_path(link.path)}});
  return list;
}

Json list_lenses(const Wording& words, const std::string& uri, const Source& source,
                 const std::vector<Lens>& lenses) {
  auto list = Json::array();
  for (const auto& lens : lenses) {
    const auto [title, command] = info(lens.deed);
    const bool of_test = lens.deed == Lens::Deed::RunTest || lens.deed == Lens::Deed::DebugTest;
    auto arguments = Json::array({uri});
    if (of_test)
      arguments.push_back(lens.name);
    list.push_back({{"range", words.range(source, lens.span)},
                    {"command",
                     {{"title", of_test && lens.name.empty() ? "run all tests" : title},
                      {"command", command},
                      {"arguments", std::move(arguments)}}}});
  }
  return list;
}

bool answers_to(std::string_view name, std::string_view query) {
  for (const char c : name)
    if (!query.empty() && to_lower(c) == to_lower(query.front()))
      query.remove_prefix(1);
  return query.empty();
}

} // namespace orb::editor
