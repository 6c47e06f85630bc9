#include "editor/lsp/methods.h"

#include "editor/lsp/shape_json.h"

#include <algorithm>
#include <array>
#include <utility>

namespace orb::editor {
namespace {

constexpr auto methods = std::to_array<Method>({
    {"textDocument/hover", true, hover},
    {"textDocument/completion", true, completion},
    {"textDocument/definition", true, definition},
    {"textDocument/references", true, references},
    {"textDocument/documentHighlight", true, highlight},
    {"textDocument/prepareRename", true, prepare_rename},
    {"textDocument/rename", true, rename},
    {"textDocument/signatureHelp", true, signature},
    {"textDocument/prepareCallHierarchy", true, callables},
    {"textDocument/documentSymbol", false, symbols},
    {"textDocument/formatting", false, format},
    {"textDocument/codeAction", false, code_actions},
    {"textDocument/inlayHint", false, hints},
    {"textDocument/semanticTokens/full", false, all_colors},
    {"textDocument/semanticTokens/range", false, colors_within},
    {"textDocument/foldingRange", false, folds},
    {"textDocument/selectionRange", false, selections},
    {"textDocument/documentLink", false, links},
    {"textDocument/codeLens", false, lenses},
});

} // namespace

const Method* find_method(std::string_view name) {
  const auto* const known = std::find_if(methods.begin(), methods.end(),
                                         [&](const Method& one) { return one.name == name; });
  return known == methods.end() ? nullptr : known;
}

Json capabilities(std::string_view encoding) {
  constexpr int incremental = 2;
  Json can = {{"positionEncoding", encoding},
              {"textDocumentSync", {{"openClose", true}, {"change", incremental}}},
              {"hoverProvider", true},
              {"completionProvider", {{"triggerCharacters", {" ", ",", "=", "'", "."}}}},
              {"definitionProvider", true},
              {"referencesProvider", true},
              {"documentHighlightProvider", true},
              {"renameProvider", {{"prepareProvider", true}}},
              {"documentSymbolProvider", true},
              {"documentFormattingProvider", true},
              {"inlayHintProvider", true},
              {"codeActionProvider",
               {{"codeActionKinds", {"quickfix", "source.fixAll", "source.renumber"}}}}};
  can.update(shape_capabilities());
  return can;
}

bool overlap(Span a, Span b) {
  return a.begin <= b.end && b.begin <= a.end;
}

int symbol_kind(OutlineKind kind) {
  switch (kind) {
  case OutlineKind::Function: return 12;
  case OutlineKind::Constant: return 14;
  case OutlineKind::Array: return 18;
  }
  return 12;
}

Json workspace_edit(const std::string& uri, Json list) {
  return {{"changes", {{uri, std::move(list)}}}};
}

} // namespace orb::editor
