#include "structured/text/read.h"

#include "assembler/assemble.h"
#include "base/path.h"
#include "base/texts.h"
#include "compiler/check.h"
#include "compiler/text/rules.h"
#include "structured/text/link_blocks.h"
#include "structured/text/parse_structured.h"
#include "structured/text/rules.h"
#include "structured/text/structured_words.h"
#include "structured/text/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace orb::structured {
namespace {

constexpr std::size_t most_files = 64; ///< of each kind

bool is_declaration(Kind kind) {
  return declares(kind) || kind == Kind::EndSub || kind == Kind::EndFunction ||
         kind == Kind::Broken;
}

class ProgramReader {
public:
  ProgramReader(Program& program, Files& files) : program_(program), files_(files) {}

  void main(std::string name, std::string path, std::string_view text) {
    if (auto refused = compiler::refuse_text(text)) {
      program_.files.push_back({std::move(name), std::move(path), 0, 0, 0, 0});
      program_.text += '\n';
      program_.diagnostics.push_back(std::move(*refused));
      return;
    }
    add(std::move(name), std::move(path), text);
  }

private:
  struct OpenFile {
    std::string path;
    std::string identity;
  };

  static bool contains(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  }

  /// Parses a file and its includes.
  void add(std::string name, std::string path, std::string_view text) {
    open_.push_back({path, files_.identity(path)});
    taken_.push_back(open_.back().identity);
    parse(program_, std::move(name), std::move(path), text);
    const auto begin = program_.files.back().statements_begin;
    const auto end = program_.files.back().statements_end;
    for (auto i = begin; i < end; ++i) {
      program_.order.push_back(i);
      const auto kind = program_.statements[i].kind;
      if (kind == Kind::Include)
        include(i);
      else if (kind == Kind::Use)
        use(i);
    }
    open_.pop_back();
  }

  /// Resolves the path in a statement relative to the current file.
  std::string path_of(std::uint32_t i) const {
    const auto quoted = program_.text_of(program_.items[program_.statements[i].items_begin].span);
    return resolve_path(open_.back().path, quoted.substr(1, quoted.size() - 2));
  }

  void report(const Rule& rule, std::uint32_t i, Message message, Message help = {}) {
    program_.diagnostics.push_back(finding(rule,
                                           program_.items[program_.statements[i].items_begin].span,
                                           std::move(message), std::move(help)));
  }

  /// Returns true if there are too many files of a kind; reports that once.
  bool is_full(std::size_t& files, std::uint32_t i, const Row<Hole::Number>& too_many) {
    if (++files == most_files + 1)
      report(rules::MissingFile, i, too_many(most_files));
    return files > most_files;
  }

  void include(std::uint32_t i) {
    auto path = path_of(i);
    const auto identity = files_.identity(path);
    if (std::any_of(open_.begin(), open_.end(),
                    [&](const OpenFile& file) { return file.identity == identity; })) {
      report(rules::IncludeCycle, i, texts::IncludesItself(path), texts::MoveIntoThird());
      return;
    }
    if (contains(taken_, identity) || is_full(included_, i, texts::TooManyIncluded))
      return;
    const auto text = read(path, i);
    if (!text)
      return;
    if (auto refused = compiler::refuse_text(*text)) {
      report(*refused->rule, i, texts::InFile(path, refused->message));
      return;
    }
    const auto first = program_.statements.size();
    add(path, path, *text);
    check_included(static_cast<std::uint32_t>(first), path);
  }

  void check_included(std::uint32_t first, const std::string& path) {
    for (auto i = first; i < program_.statements.size(); ++i) {
      const auto& statement = program_.statements[i];
      if (program_.file_at(statement.span.begin).path != path || statement.depth > 0)
        continue;
      if (is_declaration(statement.kind))
        continue;
      program_.diagnostics.push_back(finding(rules::IncludedStatement, statement.span,
                                             texts::OnlyDeclarations(), texts::MoveStatement()));
      return;
    }
  }

  std::optional<std::string> read(const std::string& path, std::uint32_t i) {
    auto text = files_.read(path);
    if (!text) {
      const auto shown = path.empty() ? "." : path;
      const auto what = files_.obstacle(path);
      report(rules::MissingFile, i,
             what.empty() ? texts::CannotRead(shown) : texts::CannotReadOther(shown, what));
    }
    return text;
  }

  void use(std::uint32_t i) {
    const auto path = path_of(i);
    auto identity = files_.identity(path);
    if (contains(taken_macros_, identity) || is_full(used_, i, texts::TooManyUsed))
      return;
    auto text = read(path, i);
    if (!text)
      return;
    const auto assembly = assembler::assemble(Source(path, *text));
    if (assembly.has_errors()) {
      report(rules::BadMacroFile, i, texts::HasErrors(path), texts::CheckShows(path));
      return;
    }
    bool any = false;
    for (const auto& macro : assembly.macros) {
      if (macro.name.empty() || !macro.id)
        continue;
      any = true;
      // Append the name to the text of the program, so that it can be interned.
      const auto begin = static_cast<std::uint32_t>(program_.text.size());
      program_.text += macro.name;
      const Span where{begin, static_cast<std::uint32_t>(program_.text.size())};
      program_.macros.push_back({intern(where), *macro.id, i});
    }
    if (!any)
      report(rules::BadMacroFile, i, texts::NoMacro(path), texts::WriteLike(".macro name id=40"));
    program_.macro_files.push_back({path, *std::move(text)});
    taken_macros_.push_back(std::move(identity));
  }

  std::uint32_t intern(Span name) {
    for (std::uint32_t i = 0; i < program_.names.size(); ++i)
      if (equal_words(program_.name(i), program_.text_of(name)))
        return i;
    program_.names.push_back(name);
    return static_cast<std::uint32_t>(program_.names.size()) - 1;
  }

  Program& program_;
  Files& files_;
  std::size_t included_ = 0;
  std::size_t used_ = 0;
  std::vector<OpenFile> open_;            ///< the chain of files being read
  std::vector<std::string> taken_;        ///< the identities of the program's files
  std::vector<std::string> taken_macros_; ///< the identities of the macro files
};

} // namespace

std::string resolve_path(std::string_view from, std::string_view path) {
  std::string whole(is_absolute_path(path) ? std::string_view()
                                           : from.substr(0, from.rfind('/') + 1));
  whole += path;
  std::vector<std::string_view> parts;
  for (std::string_view rest = whole; !rest.empty();) {
    const auto part = rest.substr(0, rest.find('/'));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    if (part == ".." && !parts.empty() && parts.back() != "..")
      parts.pop_back();
    else if (!part.empty() && part != ".")
      parts.push_back(part);
  }
  return fmt::format("{}{}", whole.starts_with('/') ? "/" : "", fmt::join(parts, "/"));
}

Message Files::obstacle(const std::string&) {
  return {};
}

Message Files::trouble(const std::string& path) {
  return orb::texts::CannotRead(path);
}

std::string Files::identity(const std::string& path) {
  return resolve_path({}, path);
}

Program read(std::string name, std::string path, std::string_view text, Files& files) {
  Program program;
  ProgramReader(program, files).main(std::move(name), std::move(path), text);
  return program;
}

} // namespace orb::structured
