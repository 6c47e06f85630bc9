#include "editor/lsp/language_server.h"

#include "base/contain.h"
#include "base/text/utf8.h"
#include "editor/lsp/methods.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace orb::editor {
namespace {

/// A message not handled yet.
struct Waiting {
  Json message; ///< discarded if it is not JSON
  bool is_cancelled = false;
  std::string fault; ///< why it is not a message; else empty
};

} // namespace

struct LanguageServer::Impl {
  Impl(structured::Files* disk, Folders* folders, Say say) : space(disk, folders, std::move(say)) {}

  Workspace space;
  std::deque<Waiting> waiting;
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

  /// Survives a bug: answers the request with an error, or logs it if there is no request.
  void fail_by_bug(const Json& id, const std::string& what) {
    if (id.is_null())
      log(what);
    else
      fail(id, {RpcError::InternalError, what});
  }

  void take(std::string_view text);
  void answer(const Waiting& next);
  Answer request(const std::string& method, const Json& params);
  Answer ask_document(const std::string& method, const Json& params);
  void notification(const std::string& method, const Json& params);

  // Requests without a document.
  Answer initialize(const Json& params);
  Answer shutdown(const Json& params);
  Answer symbols_of_all(const Json& params);
  Answer incoming_calls(const Json& params);
  Answer outgoing_calls(const Json& params);

  // Notifications.
  void exit(const Json& params);
  void did_open(const Json& params);
  void did_change(const Json& params);
  void did_close(const Json& params);
  void did_change_files(const Json& params);

  void apply(const Json& change, Document& document);
  void publish(const std::string& uri, Document& document);
  void publish_readers(const std::string& uri);
};

LanguageServer::LanguageServer(structured::Files* disk, Folders* folders, Say say)
    : impl_(std::make_unique<Impl>(disk, folders, std::move(say))) {}
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
  impl_->take(message);
}

bool LanguageServer::has_waiting() const {
  return !impl_->waiting.empty();
}

std::vector<std::string> LanguageServer::answer_next() {
  if (has_waiting()) {
    const auto next = std::move(impl_->waiting.front());
    impl_->waiting.pop_front();
    const auto answered = contain([&]() -> tl::expected<void, Failure> {
      impl_->answer(next);
      return {};
    });
    if (!answered)
      impl_->fail_by_bug(member(next.message, "id"), answered.error().message);
  }
  return std::exchange(impl_->out, {});
}

void LanguageServer::take_garbage(std::string_view what) {
  impl_->waiting.push_back({nullptr, false, std::string(what)});
}

std::vector<std::string> LanguageServer::receive_garbage(std::string_view what) {
  take_garbage(what);
  return answer_all();
}

std::optional<bool> LanguageServer::ended_well() const {
  return impl_->ended_well;
}

/// Queues a message; a cancellation takes effect at once.
void LanguageServer::Impl::take(std::string_view text) {
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

void LanguageServer::Impl::answer(const Waiting& next) {
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
    if (!is_response) // this server sends no requests, so responses are ignored
      fail(good_id ? id : Json(), {RpcError::InvalidRequest, "the message names no method"});
    return;
  }
  if (!has_id) {
    notification(method, member(message, "params"));
    return;
  }
  if (!good_id) {
    fail(nullptr, {RpcError::InvalidRequest, "an id must be a number or a string"});
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

void LanguageServer::Impl::notification(const std::string& method, const Json& params) {
  struct Row {
    std::string_view name;
    void (Impl::*take)(const Json&);
  };
  static constexpr Row rows[] = {
      {"exit", &Impl::exit},
      {"textDocument/didOpen", &Impl::did_open},
      {"textDocument/didChange", &Impl::did_change},
      {"textDocument/didClose", &Impl::did_close},
      {"workspace/didChangeWatchedFiles", &Impl::did_change_files},
  };
  for (const auto& row : rows)
    if (row.name == method && (method == "exit" || (initialized && !shut_down)))
      (this->*row.take)(params);
}

Answer LanguageServer::Impl::request(const std::string& method, const Json& params) {
  struct Row {
    std::string_view name;
    Answer (Impl::*answer)(const Json&);
  };
  static constexpr Row rows[] = {
      {"initialize", &Impl::initialize},
      {"shutdown", &Impl::shutdown},
      {"workspace/symbol", &Impl::symbols_of_all},
      {"callHierarchy/incomingCalls", &Impl::incoming_calls},
      {"callHierarchy/outgoingCalls", &Impl::outgoing_calls},
  };
  if (!initialized && method != "initialize")
    return refuse(RpcError::ServerNotInitialized, "the first request must be `initialize`");
  if (shut_down && method != "initialize")
    return refuse(RpcError::InvalidRequest, "the server is shut down");
  for (const auto& row : rows)
    if (row.name == method)
      return (this->*row.answer)(params);
  return ask_document(method, params);
}

Answer LanguageServer::Impl::ask_document(const std::string& method, const Json& params) {
  const auto* const known = find_method(method);
  if (known == nullptr)
    return refuse(RpcError::MethodNotFound,
                  fmt::format("unknown method `{}`", to_valid_utf8(method)));
  const auto uri = text_of(member(member(params, "textDocument"), "uri"));
  const auto* const document = space.find(uri);
  if (document == nullptr)
    return refuse(RpcError::InvalidParams, fmt::format("`{}` is not open", to_valid_utf8(uri)));
  std::optional<std::uint32_t> at = 0;
  if (known->has_position)
    at = space.offset(document->source, member(params, "position"));
  if (!at)
    return refuse(RpcError::InvalidParams,
                  "a position is a line and a character, both counted from 0");
  return known->answer(space, {uri, *document, params, *at});
}

Answer LanguageServer::Impl::initialize(const Json& params) {
  if (initialized)
    return refuse(RpcError::InvalidRequest, "`initialize` was already sent");
  initialized = true;
  const auto& offered =
      member(member(member(params, "capabilities"), "general"), "positionEncodings");
  // UTF-8 is free of conversions, so it is chosen if offered; every client supports UTF-16.
  const auto offers = [&](const char* name) {
    return offered.is_array() && std::find(offered.begin(), offered.end(), name) != offered.end();
  };
  const char* chosen = "utf-16";
  if (offers("utf-8")) {
    space.encoding = PositionEncoding::Utf8;
    chosen = "utf-8";
  } else if (!offers("utf-16") && offers("utf-32")) {
    space.encoding = PositionEncoding::Utf32;
    chosen = "utf-32";
  }
  const auto target = text_of(member(member(params, "initializationOptions"), "target"));
  if (const auto version = spec::find_version(target))
    space.options.target = *version;
  else if (!target.empty())
    log(fmt::format("`{}` is not an orbBasic version; checking for {}", to_valid_utf8(target),
                    spec::info(space.options.target).text));
  for (const auto& folder : member(params, "workspaceFolders"))
    space.roots.push_back(path_of_uri(text_of(member(folder, "uri"))));
  if (const auto root = text_of(member(params, "rootUri")); space.roots.empty() && !root.empty())
    space.roots.push_back(path_of_uri(root));
  return Json{{"capabilities", capabilities(chosen)},
              {"serverInfo", {{"name", "orb"}, {"version", ORB_VERSION}}}};
}

Answer LanguageServer::Impl::shutdown(const Json&) {
  shut_down = true;
  return Json();
}

Answer LanguageServer::Impl::symbols_of_all(const Json& params) {
  return workspace_symbols(space, text_of(member(params, "query")));
}

Answer LanguageServer::Impl::incoming_calls(const Json& params) {
  return calls(space, params, Related::Callers);
}

Answer LanguageServer::Impl::outgoing_calls(const Json& params) {
  return calls(space, params, Related::Callees);
}

void LanguageServer::Impl::exit(const Json&) {
  ended_well = shut_down;
}

void LanguageServer::Impl::did_open(const Json& params) {
  const auto& item = member(params, "textDocument");
  const auto uri = text_of(member(item, "uri"));
  if (uri.empty() || !member(item, "text").is_string()) {
    log("a document was opened without a name or text");
    return;
  }
  const auto& version = member(item, "version");
  Document document{Source(uri, text_of(member(item, "text"))),
                    &language_of(text_of(member(item, "languageId")), uri), std::nullopt};
  if (version.is_number_integer())
    document.version = version.get<std::int64_t>();
  const auto [place, inserted] = space.documents().insert_or_assign(uri, std::move(document));
  publish(uri, place->second);
  publish_readers(uri);
}

void LanguageServer::Impl::did_change(const Json& params) {
  const auto& item = member(params, "textDocument");
  const auto uri = text_of(member(item, "uri"));
  auto* const document = space.find(uri);
  if (document == nullptr) {
    log(fmt::format("`{}` was changed but is not open", to_valid_utf8(uri)));
    return;
  }
  const auto& version = member(item, "version");
  if (version.is_number_integer()) {
    const auto number = version.get<std::int64_t>();
    if (document->version && number < *document->version) {
      log(fmt::format("ignored version {} of a document, which came after version {}", number,
                      *document->version));
      return;
    }
    document->version = number;
  }
  const auto& changes = member(params, "contentChanges");
  if (!changes.is_array()) {
    log("ignored a change without `contentChanges`");
    return;
  }
  for (const auto& change : changes)
    apply(change, *document);
  publish(uri, *document);
  publish_readers(uri);
}

void LanguageServer::Impl::apply(const Json& change, Document& document) {
  if (!member(change, "text").is_string()) {
    log("ignored a change without text");
    return;
  }
  auto text = text_of(member(change, "text"));
  if (!member(change, "range").is_null()) {
    const auto place = space.span(document.source, member(change, "range"));
    if (!place) {
      log("ignored a change whose range is not in the text");
      return;
    }
    std::string whole(document.source.text());
    whole.replace(place->begin, place->size(), text);
    text = std::move(whole);
  }
  document.source = Source(document.source.name(), std::move(text));
}

void LanguageServer::Impl::did_close(const Json& params) {
  const auto uri = text_of(member(member(params, "textDocument"), "uri"));
  if (space.documents().erase(uri) == 0)
    return;
  notify("textDocument/publishDiagnostics", {{"uri", uri}, {"diagnostics", Json::array()}});
  publish_readers(uri); // from now on they see the file on disk
}

void LanguageServer::Impl::did_change_files(const Json& params) {
  for (const auto& change : member(params, "changes"))
    publish_readers(text_of(member(change, "uri")));
}

void LanguageServer::Impl::publish(const std::string& uri, Document& document) {
  auto list = Json::array();
  for (const auto& one : space.check(document))
    list.push_back(diagnostic(space, uri, document, one));
  Json params{{"uri", uri}, {"diagnostics", std::move(list)}};
  if (document.version)
    params["version"] = *document.version;
  notify("textDocument/publishDiagnostics", std::move(params));
}

/// Publishes the findings of open documents that include, use or test the file at `uri`.
void LanguageServer::Impl::publish_readers(const std::string& uri) {
  const auto path = path_of_uri(uri);
  for (auto& [other, document] : space.documents())
    if (other != uri && document.reads.contains(path))
      publish(other, document);
}

} // namespace orb::editor
