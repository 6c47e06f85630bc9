#include "editor/language_server.h"

#include "base/utf8.h"
#include "editor/language.h"
#include "editor/text.h"
#include "run/input.h"
#include "testing/suite.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace orb::editor {
namespace {

using Json = nlohmann::json;

// Numbers of the protocol.
enum class RpcError : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  ServerNotInitialized = -32002,
  RequestFailed = -32803,
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

/// The member `name` of `json`, or null where there is none or `json` is not an object.
const Json& member(const Json& json, const char* name) {
  static const Json null;
  if (!json.is_object())
    return null;
  const auto found = json.find(name);
  return found == json.end() ? null : *found;
}

std::string text_of(const Json& json) {
  return json.is_string() ? json.get<std::string>() : std::string();
}

/// A number that counts something; what is too large is as good as the largest.
std::optional<std::uint32_t> count_of(const Json& json) {
  if (!json.is_number_integer())
    return std::nullopt;
  if (!json.is_number_unsigned() && json.get<std::int64_t>() < 0)
    return std::nullopt;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(json.get<std::uint64_t>(), 0x7FFFFFFF));
}

struct Document {
  Source source;
  const LanguageService* language = nullptr;
  std::optional<std::int64_t> version;
};

/// The language by the editor's word for it, else by the ending of the file's name.
const LanguageService& language_of(std::string_view id, std::string_view uri) {
  if (id == "orbtest" || testing::is_test(uri))
    return test_service;
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

constexpr int symbol_kind_function = 12;

bool overlap(Span a, Span b) {
  return a.begin <= b.end && b.begin <= a.end;
}

} // namespace

struct LanguageServer::State final : structured::Files {
  explicit State(structured::Files* from) : disk(from) { options.files = this; }

  /// An open document, else what the disk holds.
  std::optional<std::string> read(const std::string& path) override {
    for (const auto& [uri, document] : documents)
      if (path_of_uri(uri) == path)
        return std::string(document.source.text());
    return disk != nullptr ? disk->read(path) : std::nullopt;
  }

  structured::Files* disk;
  std::map<std::string, Document> documents;
  PositionEncoding encoding = PositionEncoding::Utf16;
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

  void receive(std::string_view text);
  Answer request(const std::string& method, const Json& params);
  void notification(const std::string& method, const Json& params);

  // Places and edits in the words of the protocol.
  Json position(const Source& source, std::uint32_t offset) const {
    const auto place = position_of(source, offset, encoding);
    return {{"line", place.line}, {"character", place.character}};
  }
  Json range(const Source& source, Span span) const {
    return {{"start", position(source, span.begin)}, {"end", position(source, span.end)}};
  }
  Json edit(const Source& source, const Edit& one) const {
    return {{"range", range(source, one.span)}, {"newText", one.text}};
  }
  Json edits(const Source& source, const std::vector<Edit>& many) const {
    auto list = Json::array();
    for (const auto& one : many)
      list.push_back(edit(source, one));
    return list;
  }
  Json replace_all(const Source& source, const std::string& text) const {
    if (text == source.text())
      return Json::array();
    return edits(source, {{{0, static_cast<std::uint32_t>(source.text().size())}, text}});
  }
  Json workspace_edit(const std::string& uri, Json list) const {
    return {{"changes", {{uri, std::move(list)}}}};
  }
  std::optional<std::uint32_t> offset(const Source& source, const Json& place) const {
    const auto line = count_of(member(place, "line"));
    const auto character = count_of(member(place, "character"));
    if (!line || !character)
      return std::nullopt;
    return offset_of(source, {*line, *character}, encoding);
  }
  std::optional<Span> span(const Source& source, const Json& place) const {
    const auto begin = offset(source, member(place, "start"));
    const auto end = offset(source, member(place, "end"));
    if (!begin || !end)
      return std::nullopt;
    return Span{std::min(*begin, *end), std::max(*begin, *end)};
  }

  // Notifications.
  void did_open(const Json& params);
  void did_change(const Json& params);
  void did_close(const Json& params);
  void publish(const std::string& uri, const Document& document);

  // Requests.
  Answer initialize(const Json& params);
  Answer hover(const Document& document, std::uint32_t at) const;
  Answer completion(const Document& document, std::uint32_t at) const;
  Answer locations(const std::string& uri, const Document& document, const Occurrences& names,
                   bool definitions, bool uses) const;
  LanguageOptions surroundings() const;
  std::string uri_of(const Source& source) const;
  Answer highlight(const Document& document, std::uint32_t at) const;
  Answer prepare_rename(const Document& document, std::uint32_t at) const;
  Answer rename(const std::string& uri, const Document& document, std::uint32_t at,
                const Json& params) const;
  Answer symbols(const Document& document) const;
  Answer format(const Document& document) const;
  Answer code_actions(const std::string& uri, const Document& document, const Json& params) const;
  Answer hints(const Document& document, const Json& params) const;
  Json diagnostic(const std::string& uri, const Document& document, const Diagnostic& one) const;
  std::vector<Diagnostic> check(const Document& document) const;
};

LanguageServer::LanguageServer(structured::Files* disk) : state_(std::make_unique<State>(disk)) {}
LanguageServer::~LanguageServer() = default;

std::vector<std::string> LanguageServer::receive(std::string_view message) {
  state_->receive(message);
  return std::exchange(state_->out, {});
}

std::vector<std::string> LanguageServer::receive_garbage(std::string_view what) {
  state_->fail(nullptr, {RpcError::ParseError, std::string(what)});
  return std::exchange(state_->out, {});
}

std::optional<bool> LanguageServer::ended_well() const {
  return state_->ended_well;
}

void LanguageServer::State::receive(std::string_view text) {
  const auto message = Json::parse(text, nullptr, false);
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
  if (!method.starts_with("textDocument/"))
    return refuse(RpcError::MethodNotFound,
                  fmt::format("`{}` is not known here", to_valid_utf8(method)));
  const auto uri = text_of(member(member(params, "textDocument"), "uri"));
  const auto found = documents.find(uri);
  if (found == documents.end())
    return refuse(RpcError::InvalidParams, fmt::format("`{}` is not open", to_valid_utf8(uri)));
  const auto& document = found->second;
  if (method == "textDocument/documentSymbol")
    return symbols(document);
  if (method == "textDocument/formatting")
    return format(document);
  if (method == "textDocument/codeAction")
    return code_actions(uri, document, params);
  if (method == "textDocument/inlayHint")
    return hints(document, params);
  const auto at = offset(document.source, member(params, "position"));
  if (!at && member(params, "position").is_null())
    return refuse(RpcError::MethodNotFound,
                  fmt::format("`{}` is not known here", to_valid_utf8(method)));
  if (!at)
    return refuse(RpcError::InvalidParams, "a position is a line and a character, both from 0");
  if (method == "textDocument/hover")
    return hover(document, *at);
  if (method == "textDocument/completion")
    return completion(document, *at);
  if (method == "textDocument/definition" || method == "textDocument/references") {
    const auto names = document.language->occurrences(document.source, *at, surroundings());
    const auto& declared = member(member(params, "context"), "includeDeclaration");
    const bool uses = method == "textDocument/references";
    const bool definitions = !uses || !declared.is_boolean() || declared.get<bool>();
    return locations(uri, document, names, definitions, uses);
  }
  if (method == "textDocument/documentHighlight")
    return highlight(document, *at);
  if (method == "textDocument/prepareRename")
    return prepare_rename(document, *at);
  if (method == "textDocument/rename")
    return rename(uri, document, *at, params);
  return refuse(RpcError::MethodNotFound,
                fmt::format("`{}` is not known here", to_valid_utf8(method)));
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
  constexpr int incremental = 2;
  return Json{{"capabilities",
               {{"positionEncoding", chosen},
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
                 {{"codeActionKinds", {"quickfix", "source.fixAll", "source.renumber"}}}}}},
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
}

void LanguageServer::State::did_close(const Json& params) {
  const auto uri = text_of(member(member(params, "textDocument"), "uri"));
  if (documents.erase(uri) > 0)
    notify("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", Json::array()}});
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

void LanguageServer::State::publish(const std::string& uri, const Document& document) {
  auto list = Json::array();
  for (const auto& one : check(document))
    list.push_back(diagnostic(uri, document, one));
  Json params{{"uri", uri}, {"diagnostics", std::move(list)}};
  if (document.version)
    params["version"] = *document.version;
  notify("textDocument/publishDiagnostics", std::move(params));
}

Answer LanguageServer::State::hover(const Document& document, std::uint32_t at) const {
  const auto found = document.language->hover(document.source, at, surroundings());
  if (!found)
    return Json();
  return Json{{"contents", {{"kind", "markdown"}, {"value", found->markdown}}},
              {"range", range(document.source, found->span)}};
}

Answer LanguageServer::State::completion(const Document& document, std::uint32_t at) const {
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

LanguageOptions LanguageServer::State::surroundings() const {
  auto all = options;
  for (const auto& [uri, document] : documents)
    if (document.language == &structured_service)
      all.open.push_back(&document.source);
  return all;
}

/// A program's file is named by its path; an open text by its URI.
std::string LanguageServer::State::uri_of(const Source& source) const {
  for (const auto& [uri, document] : documents)
    if (uri == source.name() || path_of_uri(uri) == source.name())
      return uri;
  return uri_of_path(source.name());
}

Answer LanguageServer::State::locations(const std::string& uri, const Document& document,
                                        const Occurrences& names, bool definitions,
                                        bool uses) const {
  auto list = Json::array();
  const auto add = [&](bool wanted, const std::vector<Span>& spans) {
    if (wanted)
      for (const auto span : spans)
        list.push_back({{"uri", uri}, {"range", range(document.source, span)}});
  };
  add(definitions, names.definitions);
  add(uses, names.uses);
  for (const auto& place : names.elsewhere)
    if (place.defines ? definitions : uses)
      list.push_back({{"uri", uri_of(*place.source)}, {"range", range(*place.source, place.span)}});
  return list;
}

Answer LanguageServer::State::highlight(const Document& document, std::uint32_t at) const {
  constexpr int read = 2;
  constexpr int write = 3;
  const auto names = document.language->occurrences(document.source, at, surroundings());
  auto list = Json::array();
  for (const auto span : names.definitions)
    list.push_back({{"range", range(document.source, span)}, {"kind", write}});
  for (const auto span : names.uses)
    list.push_back({{"range", range(document.source, span)}, {"kind", read}});
  return list;
}

Answer LanguageServer::State::prepare_rename(const Document& document, std::uint32_t at) const {
  const auto names = document.language->occurrences(document.source, at, surroundings());
  for (const auto* spans : {&names.definitions, &names.uses})
    for (const auto span : *spans)
      if (span.begin <= at && at <= span.end)
        return Json{{"range", range(document.source, span)},
                    {"placeholder", document.source.text(span)}};
  return Json();
}

Answer LanguageServer::State::rename(const std::string& uri, const Document& document,
                                     std::uint32_t at, const Json& params) const {
  const auto name = text_of(member(params, "newName"));
  const auto renaming = document.language->rename(document.source, at, name, surroundings());
  if (!renaming)
    return refuse(RpcError::RequestFailed, renaming.error());
  auto changed = workspace_edit(uri, edits(document.source, renaming->edits));
  for (const auto& place : renaming->elsewhere)
    changed["changes"][uri_of(*place.source)].push_back(edit(*place.source, {place.span, name}));
  return changed;
}

Answer LanguageServer::State::symbols(const Document& document) const {
  auto list = Json::array();
  for (const auto& symbol : document.language->outline(document.source))
    list.push_back({{"name", symbol.name.empty() ? "?" : symbol.name},
                    {"detail", symbol.detail},
                    {"kind", symbol_kind_function},
                    {"range", range(document.source, symbol.span)},
                    {"selectionRange", range(document.source, symbol.selection)}});
  return list;
}

Answer LanguageServer::State::format(const Document& document) const {
  const auto text = document.language->format(document.source);
  return text ? replace_all(document.source, *text) : Json();
}

Answer LanguageServer::State::hints(const Document& document, const Json& params) const {
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

Answer LanguageServer::State::code_actions(const std::string& uri, const Document& document,
                                           const Json& params) const {
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

} // namespace orb::editor
