#pragma once

#include "editor/lsp/language_server.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// The files of a test.
class Disk final : public structured::Files {
public:
  std::map<std::string, std::string> texts;

  std::optional<std::string> read(const std::string& path) override {
    const auto found = texts.find(path);
    return found == texts.end() ? std::nullopt : std::optional(found->second);
  }
};

inline bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// A scripted editor: talks to a server in this process and records its answers.
class LspClient {
public:
  using Json = nlohmann::json;

  LspClient() = default;
  /// Starts a session that counts characters in `encoding`.
  explicit LspClient(const std::string& encoding) {
    request("initialize", {{"capabilities", {{"general", {{"positionEncodings", {encoding}}}}}}});
    notify("initialized", Json::object());
  }

  /// Sends a request; returns the whole response.
  Json request(const std::string& method, Json params) {
    const int id = ++last_id_;
    const auto messages =
        send({{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", std::move(params)}});
    for (const auto& message : messages)
      if (message.contains("id") && message["id"] == id)
        return message;
    return nullptr;
  }
  std::vector<Json> notify(const std::string& method, Json params) {
    return send({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
  }
  std::vector<Json> send(const Json& message) { return send_text(message.dump()); }
  std::vector<Json> send_text(const std::string& text) {
    std::vector<Json> messages;
    for (const auto& out : server_.receive(text)) {
      messages.push_back(Json::parse(out));
      if (messages.back().value("method", "") == "textDocument/publishDiagnostics")
        diagnostics = messages.back()["params"]["diagnostics"];
    }
    return messages;
  }

  void open(const std::string& text, const std::string& name = uri) {
    notify("textDocument/didOpen",
           {{"textDocument", {{"uri", name}, {"languageId", ""}, {"version", 1}, {"text", text}}}});
  }
  /// Sends a request about a place in the open document.
  Json at(const std::string& method, int line, int character, Json more = Json::object(),
          const std::string& name = uri) {
    more["textDocument"]["uri"] = name;
    more["position"] = {{"line", line}, {"character", character}};
    return request("textDocument/" + method, std::move(more))["result"];
  }
  /// The same for the document `document`, with the answers as an editor shows them.
  Json ask(const std::string& method, int line, int character, Json more = Json::object()) {
    return at(method, line, character, std::move(more), document);
  }
  std::string hover(int line, int character) {
    const auto found = ask("hover", line, character);
    return found.is_null() ? "" : found["contents"]["value"].get<std::string>();
  }
  bool suggests(int line, int character, const std::string& label) {
    const auto found = ask("completion", line, character);
    return std::any_of(found["items"].begin(), found["items"].end(),
                       [&](const Json& item) { return item["label"] == label; });
  }
  /// Returns the places of a rename, or why it is refused.
  std::string renamed(int line, int character, const std::string& name) {
    const auto response =
        request("textDocument/rename", {{"textDocument", {{"uri", document}}},
                                        {"position", {{"line", line}, {"character", character}}},
                                        {"newName", name}});
    return response.contains("error") ? response["error"]["message"].get<std::string>()
                                      : places(response["result"]["changes"][document]);
  }
  /// Returns `line:from-to` for each range of a list.
  static std::string places(const Json& list) {
    std::string out;
    for (const auto& one : list) {
      const auto& range = one["range"];
      out += (out.empty() ? "" : " ") + range["start"]["line"].dump() + ":" +
             range["start"]["character"].dump() + "-" + range["end"]["character"].dump();
    }
    return out;
  }
  /// Returns the codes of the latest findings.
  std::vector<std::string> codes() const {
    std::vector<std::string> found;
    for (const auto& one : diagnostics)
      found.push_back(one.value("code", ""));
    return found;
  }

  inline static const std::string uri = "file:///square.bas";
  std::string document = uri;
  Json diagnostics;
  LanguageServer& server() { return server_; }

private:
  LanguageServer server_;
  int last_id_ = 0;
};

inline nlohmann::json json_range(int line, int from, int to) {
  return {{"start", {{"line", line}, {"character", from}}},
          {"end", {{"line", line}, {"character", to}}}};
}

} // namespace orb::editor
