#include "editor/language_server.h"

#include "base/utf8.h"
#include "editor/language.h"
#include "editor/shape.h"
#include "editor/shape_answers.h"
#include "editor/text.h"
#include "editor/wording.h"
#include "run/input.h"
#include "testing/suite.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace orb::editor {
namespace {

// Numbers of the protocol.
enum class RpcError : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  ServerNotInitialized = -32002,
  RequestFailed = -32803,
  RequestCancelled = -32800,
};

/// Why a request is not answered.
struct Refusal {
  RpcError error = RpcError::InvalidParams;
  std::string message;
};

using Answer = tl::expected<Json, Refusal>;

tl::unexpected<Refusal> refuse(RpcError error, std::string message) {
  return tl::unexpected(Refusal{error, std::move(message)});
}

struct Document {
  Source source;
  const LanguageService* language = nullptr;
  std::optional<std::int64_t> version;
  std::set<std::string> reads = {}; ///< the paths that its findings were made from

  const LanguageShape& shape() const { return *language->shape; }
};

/// A message that is not looked at yet.
struct Waiting {
  Json message; ///< discarded where it is no JSON
  bool is_cancelled = false;
  std::string fault; ///< why it is no message at all; else empty
};

/// What a request about an open document is answered from.
struct Asked {
  const std::string& uri;
  const Document& document;
  const Json& params;
  std::uint32_t at = 0; ///< where the request has a position
};

/// The language by the editor's word for it, else by the ending of the file's name.
const LanguageService& language_of(std::string_view id, std::string_view uri) {
  if (id == "orbtest" || testing::is_test(uri))
    return test_service;
  if (id == "orbstimulus" || uri.ends_with(".stimulus"))
    return stimulus_service;
  const auto word = id == "orbmacro" || id == "macro"             ? std::string_view("macro")
                    : id == "orbbasic" || id == "basic"           ? std::string_view("basic")
                    : id == "orbstructured" || id == "structured" ? std::string_view("structured")
                                                                  : std::string_view();
  switch (run::language_of(uri, word).value_or(run::Language::Basic)) {
  case run::Language::Basic: return basic_service;
  case run::Language::Structured: return structured_service;
  case run::Language::Macro: return macro_service;
  }
  return basic_service;
}

int severity_number(Severity severity) {
  switch (severity) {
  case Severity::Error: return 1;
  case Severity::Warning: return 2;
  case Severity::Info: break;
  }
  return 3;
}

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

/// SymbolKind of the protocol.
int symbol_kind(OutlineKind kind) {
  switch (kind) {
  case OutlineKind::Function: return 12;
  case OutlineKind::Constant: return 14;
  case OutlineKind::Array: return 18;
  }
  return 12;
}

bool overlap(Span a, Span b) {
  return a.begin <= b.end && b.begin <= a.end;
}

} // namespace

struct LanguageServer::State final : structured::Files, Wording {
  State(structured::Files* from, Folders* in) : disk(from), folders(in) { options.files = this; }

  /// An open document, else what the disk holds.
  std::optional<std::string> read(const std::string& path) override {
    if (reads != nullptr)
      reads->insert(path);
    for (const auto& [uri, document] : documents)
      if (path_of_uri(uri) == path)
        return std::string(document.source.text());
    return disk != nullptr ? disk->read(path) : std::nullopt;
  }
  std::string obstacle(const std::string& path) override {
    return disk != nullptr ? disk->obstacle(path) : Files::obstacle(path);
  }
  std::string identity(const std::string& path) override {
    return disk != nullptr ? disk->identity(path) : Files::identity(path);
  }

  structured::Files* disk;
  Folders* folders;
  std::set<std::string>* reads = nullptr; ///< where `read` notes what it is asked for
  std::vector<std::string> roots;         ///< the paths of the folders that the editor has open
  std::map<std::string, Document> documents;
  std::deque<Waiting> waiting;
  LanguageOptions options;
  bool initialized = false;
  bool shut_down = false;
  std::optional<bool> ended_well;
  std::vector<std::string> out;

  void send(const Json& message) {
    out.push_back(message.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  void notify(const char* method, Json params) {
    send({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
  }
  void log(const std::string& message) {
    constexpr int warning = 2;
    notify("window/logMessage", {{"type", warning}, {"message", "orb: " + message}});
  }
  void fail(const Json& id, const Refusal& refusal) {
    send({{"jsonrpc", "2.0"},
          {"id", id},
          {"error", {{"code", static_cast<int>(refusal.error)}, {"message", refusal.message}}}});
  }

  void take(std::string_view text);
  void answer(const Waiting& next);
  Answer request(const std::string& method, const Json& params);
  Answer ask_document(const std::string& method, const Json& params);
  void notification(const std::string& method, const Json& params);

  Json workspace_edit(const std::string& uri, Json list) const {
    return {{"changes", {{uri, std::move(list)}}}};
  }

  // Notifications.
  void did_open(const Json& params);
  void did_change(const Json& params);
  void did_close(const Json& params);
  void publish(const std::string& uri, Document& document);
  void publish_readers(const std::string& uri);

  // Requests.
  Answer initialize(const Json& params);
  Answer hover(const Asked& asked) const;
  Answer completion(const Asked& asked) const;
  Answer definition(const Asked& asked) const;
  Answer references(const Asked& asked) const;
  Answer highlight(const Asked& asked) const;
  Answer prepare_rename(const Asked& asked) const;
  Answer rename(const Asked& asked) const;
  Answer symbols(const Asked& asked) const;
  Answer format(const Asked& asked) const;
  Answer code_actions(const Asked& asked) const;
  Answer hints(const Asked& asked) const;
  Answer all_colors(const Asked& asked) const;
  Answer colors_within(const Asked& asked) const;
  Answer folds(const Asked& asked) const;
  Answer selections(const Asked& asked) const;
  Answer signature(const Asked& asked) const;
  Answer links(const Asked& asked) const;
  Answer lenses(const Asked& asked) const;
  Answer callables(const Asked& asked) const;
  Answer calls(const Json& params, bool incoming) const;
  Answer workspace_symbols(const std::string& query) const;

  struct Method;
  static const std::vector<Method>& methods();

  Json callable(const std::string& uri, const Source& root, const Callable& one) const;
  Json locations(const Asked& asked, const Occurrences& names, bool definitions, bool uses) const;
  LanguageOptions surroundings(const std::vector<Source>& closed = {}) const;
  std::vector<Source> closed_programs(const Document& document) const;
  template <typename Visit>
  void each_closed_file(Visit visit) const;
  std::string uri_of(const Source& source) const;
  Json diagnostic(const std::string& uri, const Document& document, const Diagnostic& one) const;
  std::vector<Diagnostic> check(const Document& document) const;
};

struct LanguageServer::State::Method {
  std::string_view name;
  bool has_position = false;
  Answer (State::*answer)(const Asked&) const;
};

const std::vector<LanguageServer::State::Method>& LanguageServer::State::methods() {
  static const std::vector<Method> all{
      {"textDocument/hover", true, &State::hover},
      {"textDocument/completion", true, &State::completion},
      {"textDocument/definition", true, &State::definition},
      {"textDocument/references", true, &State::references},
      {"textDocument/documentHighlight", true, &State::highlight},
      {"textDocument/prepareRename", true, &State::prepare_rename},
      {"textDocument/rename", true, &State::rename},
      {"textDocument/signatureHelp", true, &State::signature},
      {"textDocument/prepareCallHierarchy", true, &State::callables},
      {"textDocument/documentSymbol", false, &State::symbols},
      {"textDocument/formatting", false, &State::format},
      {"textDocument/codeAction", false, &State::code_actions},
      {"textDocument/inlayHint", false, &State::hints},
      {"textDocument/semanticTokens/full", false, &State::all_colors},
      {"textDocument/semanticTokens/range", false, &State::colors_within},
      {"textDocument/foldingRange", false, &State::folds},
      {"textDocument/selectionRange", false, &State::selections},
      {"textDocument/documentLink", false, &State::links},
      {"textDocument/codeLens", false, &State::lenses},
  };
  return all;
}

LanguageServer::LanguageServer(structured::Files* disk, Folders* folders)
    : state_(std::make_unique<State>(disk, folders)) {}
LanguageServer::~LanguageServer() = default;

std::vector<std::string> LanguageServer::receive(std::string_view message) {
  take(message);
  return answer_all();
}

std::vector<std::string> LanguageServer::answer_all() {
  std::vector<std::string> all;
  while (has_waiting())
    for (auto& one : answer_next())
      all.push_back(std::move(one));
  return all;
}

void LanguageServer::take(std::string_view message) {
  state_->take(message);
}

bool LanguageServer::has_waiting() const {
  return !state_->waiting.empty();
}

std::vector<std::string> LanguageServer::answer_next() {
  if (has_waiting()) {
    const auto next = std::move(state_->waiting.front());
    state_->waiting.pop_front();
    state_->answer(next);
  }
  return std::exchange(state_->out, {});
}

void LanguageServer::take_garbage(std::string_view what) {
  state_->waiting.push_back({nullptr, false, std::string(what)});
}

std::vector<std::string> LanguageServer::receive_garbage(std::string_view what) {
  take_garbage(what);
  return answer_all();
}

std::optional<bool> LanguageServer::ended_well() const {
  return state_->ended_well;
}

/// Puts a message behind those that wait; one that cancels takes effect on them at once.
void LanguageServer::State::take(std::string_view text) {
  auto message = Json::parse(text, nullptr, false);
  if (text_of(member(message, "method")) != "$/cancelRequest") {
    waiting.push_back({std::move(message), false, {}});
    return;
  }
  const auto& id = member(member(message, "params"), "id");
  for (auto& one : waiting)
    if (!id.is_null() && member(one.message, "id") == id)
      one.is_cancelled = true;
}

void LanguageServer::State::answer(const Waiting& next) {
  const auto& message = next.message;
  if (!next.fault.empty()) {
    fail(nullptr, {RpcError::ParseError, next.fault});
    return;
  }
  if (message.is_discarded()) {
    fail(nullptr, {RpcError::ParseError, "the message is not JSON"});
    return;
  }
  const auto& id = member(message, "id");
  const bool has_id = message.is_object() && message.contains("id");
  const bool good_id = id.is_string() || id.is_number_integer();
  const auto method = text_of(member(message, "method"));
  if (method.empty()) {
    const bool is_response = has_id && (message.contains("result") || message.contains("error"));
    if (!is_response) // this server asks nothing, so a response answers nothing
      fail(good_id ? id : Json(), {RpcError::InvalidRequest, "the message names no method"});
    return;
  }
  if (!has_id) {
    notification(method, member(message, "params"));
    return;
  }
  if (!good_id) {
    fail(nullptr, {RpcError::InvalidRequest, "an id is a number or a string"});
    return;
  }
  if (next.is_cancelled) {
    fail(id, {RpcError::RequestCancelled, "cancelled"});
    return;
  }
  auto answer = request(method, member(message, "params"));
  if (answer)
    send({{"jsonrpc", "2.0"}, {"id", id}, {"result", *std::move(answer)}});
  else
    fail(id, answer.error());
}

void LanguageServer::State::notification(const std::string& method, const Json& params) {
  if (method == "exit")
    ended_well = shut_down;
  if (!initialized || shut_down)
    return;
  if (method == "textDocument/didOpen")
    did_open(params);
  else if (method == "textDocument/didChange")
    did_change(params);
  else if (method == "textDocument/didClose")
    did_close(params);
  else if (method == "workspace/didChangeWatchedFiles")
    for (const auto& change : member(params, "changes"))
      publish_readers(text_of(member(change, "uri")));
}

Answer LanguageServer::State::request(const std::string& method, const Json& params) {
  if (method == "initialize")
    return initialize(params);
  if (!initialized)
    return refuse(RpcError::ServerNotInitialized, "the first request is `initialize`");
  if (shut_down)
    return refuse(RpcError::InvalidRequest, "the server is shut down");
  if (method == "shutdown") {
    shut_down = true;
    return Json();
  }
  if (method == "workspace/symbol")
    return workspace_symbols(text_of(member(params, "query")));
  if (method == "callHierarchy/incomingCalls" || method == "callHierarchy/outgoingCalls")
    return calls(params, method == "callHierarchy/incomingCalls");
  return ask_document(method, params);
}

Answer LanguageServer::State::ask_document(const std::string& method, const Json& params) {
  const auto known = std::find_if(methods().begin(), methods().end(),
                                  [&](const Method& one) { return one.name == method; });
  if (known == methods().end())
    return refuse(RpcError::MethodNotFound,
                  fmt::format("`{}` is not known here", to_valid_utf8(method)));
  const auto uri = text_of(member(member(params, "textDocument"), "uri"));
  const auto found = documents.find(uri);
  if (found == documents.end())
    return refuse(RpcError::InvalidParams, fmt::format("`{}` is not open", to_valid_utf8(uri)));
  const auto& document = found->second;
  std::optional<std::uint32_t> at = 0;
  if (known->has_position)
    at = offset(document.source, member(params, "position"));
  if (!at)
    return refuse(RpcError::InvalidParams, "a position is a line and a character, both from 0");
  return (this->*known->answer)({uri, document, params, *at});
}

Answer LanguageServer::State::initialize(const Json& params) {
  if (initialized)
    return refuse(RpcError::InvalidRequest, "`initialize` comes once");
  initialized = true;
  const auto& offered =
      member(member(member(params, "capabilities"), "general"), "positionEncodings");
  // UTF-8 costs nothing here, so it is taken where it is offered; UTF-16 is what all clients know.
  const auto offers = [&](const char* name) {
    return offered.is_array() && std::find(offered.begin(), offered.end(), name) != offered.end();
  };
  const char* chosen = "utf-16";
  if (offers("utf-8")) {
    encoding = PositionEncoding::Utf8;
    chosen = "utf-8";
  } else if (!offers("utf-16") && offers("utf-32")) {
    encoding = PositionEncoding::Utf32;
    chosen = "utf-32";
  }
  const auto target = text_of(member(member(params, "initializationOptions"), "target"));
  if (const auto version = spec::find_version(target))
    options.target = *version;
  else if (!target.empty())
    log(fmt::format("`{}` is not a version of orbBasic; checking for {}", to_valid_utf8(target),
                    spec::info(options.target).text));
  for (const auto& folder : member(params, "workspaceFolders"))
    roots.push_back(path_of_uri(text_of(member(folder, "uri"))));
  if (const auto root = text_of(member(params, "rootUri")); roots.empty() && !root.empty())
    roots.push_back(path_of_uri(root));
  constexpr int incremental = 2;
  Json capabilities = {{"positionEncoding", chosen},
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
  capabilities.update(shape_capabilities());
  return Json{{"capabilities", std::move(capabilities)},
              {"serverInfo", {{"name", "orb"}, {"version", ORB_VERSION}}}};
}

void LanguageServer::State::did_open(const Json& params) {
  const auto& item = member(params, "textDocument");
  const auto uri = text_of(member(item, "uri"));
  if (uri.empty() || !member(item, "text").is_string()) {
    log("a document was opened without a name or a text");
    return;
  }
  const auto& version = member(item, "version");
  Document document{Source(uri, text_of(member(item, "text"))),
                    &language_of(text_of(member(item, "languageId")), uri), std::nullopt};
  if (version.is_number_integer())
    document.version = version.get<std::int64_t>();
  const auto [place, inserted] = documents.insert_or_assign(uri, std::move(document));
  publish(uri, place->second);
  publish_readers(uri);
}

void LanguageServer::State::did_change(const Json& params) {
  const auto& item = member(params, "textDocument");
  const auto uri = text_of(member(item, "uri"));
  const auto found = documents.find(uri);
  if (found == documents.end()) {
    log(fmt::format("`{}` was changed but is not open", to_valid_utf8(uri)));
    return;
  }
  auto& document = found->second;
  const auto& version = member(item, "version");
  if (version.is_number_integer()) {
    const auto number = version.get<std::int64_t>();
    if (document.version && number < *document.version) {
      log(fmt::format("version {} of a document came after version {} and is left out", number,
                      *document.version));
      return;
    }
    document.version = number;
  }
  const auto& changes = member(params, "contentChanges");
  if (!changes.is_array()) {
    log("a change without `contentChanges`");
    return;
  }
  for (const auto& change : changes) {
    if (!member(change, "text").is_string()) {
      log("a change without a text is left out");
      continue;
    }
    auto text = text_of(member(change, "text"));
    if (!member(change, "range").is_null()) {
      const auto place = span(document.source, member(change, "range"));
      if (!place) {
        log("ignored a change whose range is not in the text");
        continue;
      }
      std::string whole(document.source.text());
      whole.replace(place->begin, place->size(), text);
      text = std::move(whole);
    }
    document.source = Source(uri, std::move(text));
  }
  publish(uri, document);
  publish_readers(uri);
}

void LanguageServer::State::did_close(const Json& params) {
  const auto uri = text_of(member(member(params, "textDocument"), "uri"));
  if (documents.erase(uri) == 0)
    return;
  notify("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", Json::array()}});
  publish_readers(uri); // from now on they see what the disk holds
}

std::vector<Diagnostic> LanguageServer::State::check(const Document& document) const {
  return document.language->check(document.source, options);
}

Json LanguageServer::State::diagnostic(const std::string& uri, const Document& document,
                                       const Diagnostic& one) const {
  Json json{{"range", range(document.source, one.span)},
            {"severity", severity_number(one.severity)},
            {"source", "orb"},
            {"message", one.help.empty() ? one.message : one.message + "\n" + one.help}};
  if (one.rule != nullptr)
    json["code"] = one.rule->id;
  for (const auto& note : one.notes)
    json["relatedInformation"].push_back(
        {{"location", {{"uri", uri}, {"range", range(document.source, note.span)}}},
         {"message", note.message}});
  return json;
}

void LanguageServer::State::publish(const std::string& uri, Document& document) {
  auto list = Json::array();
  document.reads.clear();
  reads = &document.reads;
  for (const auto& one : check(document))
    list.push_back(diagnostic(uri, document, one));
  reads = nullptr;
  Json params{{"uri", uri}, {"diagnostics", std::move(list)}};
  if (document.version)
    params["version"] = *document.version;
  notify("textDocument/publishDiagnostics", std::move(params));
}

/// The findings of the open documents that include, use or test the file that `uri` names.
void LanguageServer::State::publish_readers(const std::string& uri) {
  const auto path = path_of_uri(uri);
  for (auto& [other, document] : documents)
    if (other != uri && document.reads.contains(path))
      publish(other, document);
}

Answer LanguageServer::State::hover(const Asked& asked) const {
  const auto& [uri, document, params, at] = asked;
  const auto found = document.language->hover(document.source, at, surroundings());
  if (!found)
    return Json();
  return Json{{"contents", {{"kind", "markdown"}, {"value", found->markdown}}},
              {"range", range(document.source, found->span)}};
}

Answer LanguageServer::State::completion(const Asked& asked) const {
  const auto& [uri, document, params, at] = asked;
  const auto found = document.language->suggest(document.source, at, surroundings());
  const auto place = range(document.source, found.replaces);
  auto list = Json::array();
  for (std::size_t i = 0; i < found.items.size(); ++i) {
    const auto& item = found.items[i];
    Json json{{"label", item.label},
              {"kind", kind_number(item.kind)},
              {"sortText", fmt::format("{:04}", i)}, // the tables' order is the readers' order
              {"textEdit", {{"range", place}, {"newText", item.label}}}};
    if (!item.detail.empty())
      json["detail"] = item.detail;
    if (!item.markdown.empty())
      json["documentation"] = {{"kind", "markdown"}, {"value", item.markdown}};
    list.push_back(std::move(json));
  }
  return Json{{"isIncomplete", false}, {"items", std::move(list)}};
}

LanguageOptions LanguageServer::State::surroundings(const std::vector<Source>& closed) const {
  auto all = options;
  for (const auto& program : closed)
    all.open.push_back(&program);
  for (const auto& [uri, document] : documents)
    if (document.language == &structured_service)
      all.open.push_back(&document.source);
  return all;
}

/// Calls `visit` with the path and the text of each file of the open folders that is not open.
template <typename Visit>
void LanguageServer::State::each_closed_file(Visit visit) const {
  if (folders == nullptr || disk == nullptr)
    return;
  for (const auto& root : roots)
    for (const auto& path : folders->sources(root)) {
      auto text = documents.contains(uri_of_path(path)) ? std::nullopt : disk->read(path);
      if (text)
        visit(path, *std::move(text));
    }
}

/// The programs on the disk that may include a structured program.
std::vector<Source> LanguageServer::State::closed_programs(const Document& document) const {
  std::vector<Source> programs;
  if (document.language != &structured_service)
    return programs;
  each_closed_file([&](const std::string& path, std::string text) {
    if (&language_of("", uri_of_path(path)) == document.language)
      programs.emplace_back(path, std::move(text));
  });
  return programs;
}

/// A program's file is named by its path; an open text by its URI.
std::string LanguageServer::State::uri_of(const Source& source) const {
  for (const auto& [uri, document] : documents)
    if (uri == source.name() || path_of_uri(uri) == source.name())
      return uri;
  return uri_of_path(source.name());
}

Json LanguageServer::State::locations(const Asked& asked, const Occurrences& names,
                                      bool definitions, bool uses) const {
  auto list = Json::array();
  const auto add = [&](bool wanted, const std::vector<Span>& spans) {
    if (wanted)
      for (const auto span : spans)
        list.push_back({{"uri", asked.uri}, {"range", range(asked.document.source, span)}});
  };
  add(definitions, names.definitions);
  add(uses, names.uses);
  for (const auto& place : names.elsewhere)
    if (place.defines ? definitions : uses)
      list.push_back({{"uri", uri_of(*place.source)}, {"range", range(*place.source, place.span)}});
  return list;
}

Answer LanguageServer::State::definition(const Asked& asked) const {
  const auto& source = asked.document.source;
  return locations(asked, asked.document.language->occurrences(source, asked.at, surroundings()),
                   true, false);
}

Answer LanguageServer::State::references(const Asked& asked) const {
  const auto& source = asked.document.source;
  const auto& declared = member(member(asked.params, "context"), "includeDeclaration");
  const auto closed = closed_programs(asked.document);
  const auto all = surroundings(closed);
  return locations(asked, asked.document.language->occurrences(source, asked.at, all),
                   !declared.is_boolean() || declared.get<bool>(), true);
}

Answer LanguageServer::State::highlight(const Asked& asked) const {
  const auto& document = asked.document;
  constexpr int read = 2;
  constexpr int write = 3;
  const auto names = document.language->occurrences(document.source, asked.at, surroundings());
  auto list = Json::array();
  for (const auto span : names.definitions)
    list.push_back({{"range", range(document.source, span)}, {"kind", write}});
  for (const auto span : names.uses)
    list.push_back({{"range", range(document.source, span)}, {"kind", read}});
  return list;
}

Answer LanguageServer::State::prepare_rename(const Asked& asked) const {
  const auto& document = asked.document;
  const auto at = asked.at;
  const auto names = document.language->occurrences(document.source, at, surroundings());
  for (const auto* spans : {&names.definitions, &names.uses})
    for (const auto span : *spans)
      if (span.begin <= at && at <= span.end)
        return Json{{"range", range(document.source, span)},
                    {"placeholder", document.source.text(span)}};
  return Json();
}

Answer LanguageServer::State::rename(const Asked& asked) const {
  const auto& [uri, document, params, at] = asked;
  const auto name = text_of(member(params, "newName"));
  const auto closed = closed_programs(document);
  const auto renaming = document.language->rename(document.source, at, name, surroundings(closed));
  if (!renaming)
    return refuse(RpcError::RequestFailed, renaming.error());
  auto changed = workspace_edit(uri, edits(document.source, renaming->edits));
  for (const auto& place : renaming->elsewhere)
    changed["changes"][uri_of(*place.source)].push_back(edit(*place.source, {place.span, name}));
  return changed;
}

Answer LanguageServer::State::symbols(const Asked& asked) const {
  const auto& document = asked.document;
  auto list = Json::array();
  for (const auto& symbol : document.language->outline(document.source))
    list.push_back({{"name", symbol.name.empty() ? "?" : symbol.name},
                    {"detail", symbol.detail},
                    {"kind", symbol_kind(symbol.kind)},
                    {"range", range(document.source, symbol.span)},
                    {"selectionRange", range(document.source, symbol.selection)}});
  return list;
}

Answer LanguageServer::State::format(const Asked& asked) const {
  const auto& document = asked.document;
  const auto text = document.language->format(document.source);
  return text ? replace_all(document.source, *text) : Json();
}

Answer LanguageServer::State::hints(const Asked& asked) const {
  const auto& document = asked.document;
  const auto& params = asked.params;
  const auto place = span(document.source, member(params, "range"));
  if (!place)
    return refuse(RpcError::InvalidParams, "a range has a start and an end");
  auto list = Json::array();
  if (document.language->hints == nullptr)
    return list;
  for (const auto& hint : document.language->hints(document.source, options))
    if (place->begin <= hint.at && hint.at <= place->end)
      list.push_back({{"position", position(document.source, hint.at)},
                      {"label", hint.label},
                      {"tooltip", hint.tooltip},
                      {"paddingLeft", !hint.label.starts_with(':')}});
  return list;
}

Answer LanguageServer::State::code_actions(const Asked& asked) const {
  const auto& uri = asked.uri;
  const auto& document = asked.document;
  const auto& params = asked.params;
  const auto place = span(document.source, member(params, "range"));
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
  for (const auto& one : check(document)) {
    if (!one.fix)
      continue;
    if (!overlap(one.span, *place) || !wanted("quickfix"))
      continue;
    list.push_back({{"title", one.fix->title},
                    {"kind", "quickfix"},
                    {"isPreferred", one.fix->safety == Safety::Safe},
                    {"diagnostics", Json::array({diagnostic(uri, document, one)})},
                    {"edit", workspace_edit(uri, edits(document.source, one.fix->edits))}});
  }
  for (const auto& rewrite : document.language->rewrites(document.source, options))
    if (wanted(rewrite.kind))
      list.push_back({{"title", rewrite.title},
                      {"kind", rewrite.kind},
                      {"edit", workspace_edit(uri, replace_all(document.source, rewrite.text))}});
  return list;
}

// ---- what the shape of a text says

Answer LanguageServer::State::all_colors(const Asked& asked) const {
  const auto& source = asked.document.source;
  return pack_colors(*this, source, asked.document.shape().colors(source, options),
                     {0, static_cast<std::uint32_t>(source.text().size())});
}

Answer LanguageServer::State::colors_within(const Asked& asked) const {
  const auto& source = asked.document.source;
  const auto place = span(source, member(asked.params, "range"));
  if (!place)
    return refuse(RpcError::InvalidParams, "a range has a start and an end");
  return pack_colors(*this, source, asked.document.shape().colors(source, options), *place);
}

Answer LanguageServer::State::folds(const Asked& asked) const {
  return list_folds(asked.document.shape().folds(asked.document.source));
}

Answer LanguageServer::State::selections(const Asked& asked) const {
  const auto& source = asked.document.source;
  const auto& positions = member(asked.params, "positions");
  if (!positions.is_array())
    return refuse(RpcError::InvalidParams, "`positions` is a list of places");
  auto list = Json::array();
  for (const auto& one : positions) {
    const auto at = offset(source, one);
    if (!at)
      return refuse(RpcError::InvalidParams, "a position is a line and a character, both from 0");
    list.push_back(nest_ranges(*this, source,
                               nested(source, *at, asked.document.shape().around(source, *at))));
  }
  return list;
}

Answer LanguageServer::State::signature(const Asked& asked) const {
  const auto& document = asked.document;
  const auto found = document.shape().signature(document.source, asked.at, options);
  return found ? describe(*found) : Json();
}

Answer LanguageServer::State::links(const Asked& asked) const {
  const auto& document = asked.document;
  auto* const links = document.shape().links;
  return list_links(*this, document.source,
                    links != nullptr ? links(document.source) : std::vector<Link>());
}

Answer LanguageServer::State::lenses(const Asked& asked) const {
  const auto& document = asked.document;
  auto* const lenses = document.shape().lenses;
  return list_lenses(*this, asked.uri, document.source,
                     lenses != nullptr ? lenses(document.source) : std::vector<Lens>());
}

// ---- who calls whom

/// `root` is the document whose program it is; later requests about it come back with its URI.
Json LanguageServer::State::callable(const std::string& uri, const Source& root,
                                     const Callable& one) const {
  const auto& source = one.source != nullptr ? *one.source : root;
  Json json{{"name", one.name},
            {"kind", symbol_kind(OutlineKind::Function)},
            {"uri", one.source != nullptr ? uri_of(source) : uri},
            {"range", range(source, one.span)},
            {"selectionRange", range(source, one.selection)},
            {"data", {{"root", uri}, {"name", one.name}}}};
  if (!one.detail.empty())
    json["detail"] = one.detail;
  return json;
}

Answer LanguageServer::State::callables(const Asked& asked) const {
  const auto& [uri, document, params, at] = asked;
  if (document.shape().calls == nullptr)
    return Json();
  const auto all = document.shape().calls(document.source, options);
  std::optional<std::size_t> found;
  const auto take = [&](std::size_t index) { found = found ? found : std::optional(index); };
  for (const auto& call : all.calls)
    if (all.callables[call.caller].source == nullptr && touches(call.site, at))
      take(call.callee);
  for (std::size_t i = 0; i < all.callables.size(); ++i)
    if (all.callables[i].source == nullptr && touches(all.callables[i].selection, at))
      take(i);
  return found ? Json::array({callable(uri, document.source, all.callables[*found])}) : Json();
}

Answer LanguageServer::State::calls(const Json& params, bool incoming) const {
  const auto& data = member(member(params, "item"), "data");
  const auto uri = text_of(member(data, "root"));
  const auto name = text_of(member(data, "name"));
  const auto found = documents.find(uri);
  if (found == documents.end() || found->second.shape().calls == nullptr)
    return refuse(RpcError::InvalidParams, "the item is none of an open document");
  const auto& root = found->second.source;
  const auto all = found->second.shape().calls(root, options);
  std::map<std::size_t, Json> sites; // by the other end
  for (const auto& call : all.calls) {
    const auto& caller = all.callables[call.caller];
    if (all.callables[incoming ? call.callee : call.caller].name != name)
      continue;
    auto& list = sites[incoming ? call.caller : call.callee];
    list.push_back(range(caller.source != nullptr ? *caller.source : root, call.site));
  }
  auto list = Json::array();
  for (const auto& [other, ranges] : sites)
    list.push_back({{incoming ? "from" : "to", callable(uri, root, all.callables[other])},
                    {"fromRanges", ranges}});
  return list;
}

/// The outlines of what is open, then of what lies in the open folders.
Answer LanguageServer::State::workspace_symbols(const std::string& query) const {
  constexpr std::size_t most = 500;
  auto list = Json::array();
  const auto add = [&](const std::string& uri, const Source& source,
                       const LanguageService& language) {
    for (const auto& symbol : language.outline(source))
      if (answers_to(symbol.name, query) && list.size() < most)
        list.push_back({{"name", symbol.name},
                        {"kind", symbol_kind(symbol.kind)},
                        {"containerName", symbol.detail},
                        {"location", {{"uri", uri}, {"range", range(source, symbol.selection)}}}});
  };
  for (const auto& [uri, document] : documents)
    add(uri, document.source, *document.language);
  each_closed_file([&](const std::string& path, std::string text) {
    const auto uri = uri_of_path(path);
    add(uri, Source(uri, std::move(text)), language_of("", uri));
  });
  return list;
}

} // namespace orb::editor
