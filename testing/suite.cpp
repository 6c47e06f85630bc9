#include "testing/suite.h"

#include "base/fixes.h"
#include "base/render.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "compiler/text/image.h"
#include "report/rules.h"
#include "testing/check_javascript.h"
#include "testing/check_room.h"
#include "testing/lookup.h"
#include "testing/meant.h"
#include "testing/text/rules.h"
#include "testing/texts.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <span>
#include <utility>

namespace orb::testing {
namespace {

constexpr std::array<std::string_view, 4> endings{".orb", ".bas", ".macro", ".js"};

/// The file extension of programs handed in as plain text.
constexpr std::string_view plain_ending = ".txt";

/// The errors that keep a source from compiling, as text.
std::string errors_of(const Source& source, const std::vector<Diagnostic>& findings,
                      const Say& say) {
  std::string text;
  for (const auto& one : findings)
    if (is_error(one))
      text += render_text(source, one, {}, say);
  return text;
}

/// Why an input cannot be run; empty if it can.
std::string problem_of(const run::Input& input, const Say& say) {
  std::string text;
  for (const auto& file : input.errors)
    text += errors_of(*file.source, file.diagnostics, say);
  if (!text.empty() || !input.program || input.program->compiled)
    return text;
  // The robot reports a line that it cannot read only when it runs it; a test reports it at once.
  const auto& parsed = input.program->parsed;
  const auto line_of = [&](Span span) { return input.source->position(span.begin).line; };
  std::set<std::uint32_t> unread;
  for (const auto& fault : parsed.faults)
    unread.insert(line_of(fault.span));
  if (unread.empty())
    return text;
  for (const auto& one : compiler::lint(parsed, {}))
    if (is_error(one) && unread.contains(line_of(one.span)))
      text += render_text(*input.source, one, {}, say);
  return text;
}

/// Reads each file once: a pipe, for instance, cannot be read twice.
class EachOnce final : public structured::Files {
public:
  explicit EachOnce(structured::Files& files) : files_(files) {}

  std::optional<std::string> read(const std::string& path) override {
    const auto [at, fresh] = texts_.try_emplace(path);
    if (fresh)
      at->second = files_.read(path);
    return at->second;
  }
  Message obstacle(const std::string& path) override { return files_.obstacle(path); }
  Message trouble(const std::string& path) override { return files_.trouble(path); }
  std::string identity(const std::string& path) override { return files_.identity(path); }

private:
  structured::Files& files_;
  std::map<std::string, std::optional<std::string>> texts_;
};

class SuiteReader {
public:
  SuiteReader(Suite& suite, structured::Files& files, const SuiteOptions& options)
      : suite_(suite), files_(files), options_(options) {}

  /// Returns the index of a program compiled with the files of `file`; an unreadable one is a
  /// problem of its own.
  std::size_t program(const std::string& path, const SuiteFile& file) {
    return program(path, file, {});
  }

  /// Returns the program that a test runs: the given one, or, if the test looks at variables of a
  /// structured program, a build that keeps them.
  std::size_t program_of(const Test& test, std::size_t program, const SuiteFile& file) {
    std::vector<std::string> names;
    for (const auto& one : test.expectations)
      if (one.word == Word::Variable)
        names.push_back(one.name.text);
    const auto& plain = suite_.programs[program];
    const auto* const first = run::first_with_program(plain.inputs);
    if (names.empty() || !plain.problem.empty() || first == nullptr || !first->program->compiled)
      return program;
    const auto flashed = plain.packed_bytes;
    const auto index = this->program(std::string(plain.name), file, std::move(names));
    suite_.programs[index].packed_bytes = flashed;
    return index;
  }

private:
  std::size_t program(const std::string& path, const SuiteFile& file,
                      std::vector<std::string> kept) {
    const auto& target = file.file.target;
    std::string key = fmt::format("{}\n{}\n{}\n{}\n{}", path, static_cast<int>(target.version),
                                  static_cast<int>(target_of(file.file).version),
                                  static_cast<int>(target.area), file.source->name());
    if (file.file.with.empty())
      key.resize(key.rfind('\n'));
    for (const auto& name : kept)
      key += fmt::format("\n={}", name);
    const auto [at, fresh] = known_.try_emplace(key, suite_.programs.size());
    if (fresh)
      suite_.programs.push_back(prepare(path, file, kept));
    return at->second;
  }

  Prepared prepare(const std::string& path, const SuiteFile& file,
                   const std::vector<std::string>& kept) {
    Prepared made;
    made.name = path;
    if (const auto trouble = options_.troubles.find(path); trouble != options_.troubles.end()) {
      made.problem = trouble->second + "\n";
      made.missing = options_.missing.contains(path);
      return made;
    }
    std::vector<run::Input> rest;
    read(path, file, made, made.inputs, kept);
    for (const auto& with : file.file.with)
      read(structured::resolve_path(file.source->name(), with.text), file, made, rest, {});
    for (auto& one : rest)
      run::add_input(made.inputs, std::move(one));
    if (!made.problem.empty())
      return made;
    if (const auto* first = run::first_with_program(made.inputs))
      made.packed_bytes = made.tested_bytes =
          compiler::build_image(first->program->parsed, compiler::Packing::Packed).bytes.size();
    for (const auto& input : made.inputs)
      for (const auto& macro : input.macros)
        made.macros.emplace(macro.name, macro.image.id);
    return made;
  }

  void read(const std::string& path, const SuiteFile& file, Prepared& made,
            std::vector<run::Input>& inputs, const std::vector<std::string>& kept) {
    auto text = files_.read(path);
    if (!text) {
      made.problem += options_.say(files_.trouble(path)) + "\n";
      return;
    }
    if (text->find('\0') != std::string::npos) {
      made.problem += options_.say(texts::NotText(path));
      made.problem += "\n";
      return;
    }
    if (path == made.name && is_javascript(path)) {
      made.elsewhere = where_tested(path, options_.say);
      return;
    }
    const auto language =
        has_ending(path, plain_ending) ? run::language_of_text(*text) : std::string_view();
    made.language += path == made.name ? language : "";
    auto input = run::read_input(path, *std::move(text), language, file.file.target, files_, kept,
                                 options_.shape);
    if (!input) {
      made.problem += run::content_of(path, language)
                          ? input.error().message + "\n"
                          : options_.say(texts::UnknownKind(
                                path, fmt::format("{}", fmt::join(endings, ", ")))) +
                                "\n";
      return;
    }
    input->target = target_of(file.file);
    made.problem += problem_of(*input, options_.say);
    run::add_input(inputs, *std::move(input));
  }

  Suite& suite_;
  structured::Files& files_;
  const SuiteOptions& options_;
  std::map<std::string, std::size_t> known_;
};

std::string beside(const std::string& name, std::string_view ending) {
  const auto dot = name.rfind('.');
  return name.substr(0, dot) + std::string(ending);
}

std::string capitals(std::string_view ending) {
  std::string made(ending);
  std::transform(made.begin(), made.end(), made.begin(), to_upper);
  return made;
}

/// Reports a line `WORD NAME` whose file cannot be read. Suggests the name with an extension, or
/// with slashes as other systems write them.
Diagnostic cannot_read(std::string_view word, const Named& given, const std::string& path,
                       std::span<const std::string_view> possible, structured::Files& files) {
  auto d = finding(rules::File, given.span, texts::CannotRead(path), texts::FromFolderOfTest());
  const auto slashes = [](std::string text) {
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
  };
  std::vector<std::string_view> all{""};
  all.insert(all.end(), possible.begin(), possible.end());
  const auto ending = std::find_if(all.begin(), all.end(), [&](std::string_view one) {
    return files.read(slashes(path) + std::string(one)).has_value();
  });
  if (ending != all.end()) {
    const auto name = slashes(given.text) + std::string(*ending);
    d.help = texts::Write(fmt::format("{} {}", word, name));
    d.fix = single_fix(d.help, given.span, name, Safety::Unsafe);
  }
  return d;
}

/// Returns the path of the test file's program; nothing, and a finding, if there is none.
std::optional<std::string> program_path(SuiteFile& file, structured::Files& files) {
  const auto& name = file.source->name();
  auto& findings = file.file.diagnostics;
  const auto& balls = file.file.balls;
  if (const auto& given = balls.empty() ? file.file.program : std::optional(balls[0].program)) {
    if (given->text.empty())
      return std::nullopt; // the line's error is already reported
    auto path = structured::resolve_path(name, given->text);
    if (files.read(path))
      return path;
    findings.push_back(cannot_read("program", *given, path, endings, files));
    return std::nullopt;
  }
  for (const auto ending : endings)
    for (const auto& path : {beside(name, ending), beside(name, capitals(ending))})
      if (files.read(path))
        return path;
  findings.push_back(finding(rules::NoProgram, {0, 0},
                             texts::NoProgram(beside(name, endings[0]), beside(name, endings[1]),
                                              beside(name, endings[2])),
                             texts::NameAProgram()));
  findings.back().severity = Severity::Error; // an error when run; check() lowers it
  return std::nullopt;
}

/// Reports a test that runs a program other than the one that is flashed.
void tell_of_kept(SuiteFile& file, const Test& test, const Prepared& program) {
  const auto first = std::find_if(test.expectations.begin(), test.expectations.end(),
                                  [](const auto& one) { return one.word == Word::Variable; });
  if (first == test.expectations.end() || program.tested_bytes == program.packed_bytes)
    return;
  file.file.diagnostics.push_back(
      finding(rules::KeptVariable, first->name.span,
              texts::RunsKept(program.name, program.tested_bytes, program.packed_bytes)));
}

/// Reports unknown names in a file, looked up in the program that it names itself.
void check_names(SuiteFile& file, const Suite& suite, SuiteReader& reader,
                 std::optional<std::size_t> named) {
  static const Prepared none;
  for (const auto& test : file.file.tests) {
    const auto* const own =
        named ? &suite.programs[reader.program_of(test, *named, file)] : nullptr;
    if (own != nullptr && own->problem.empty())
      tell_of_kept(file, test, *own);
    for (const auto& whole : test.expectations)
      for (const auto* one : parts_of(whole)) {
        if (whole.ball && *whole.ball > 0 && one->word == Word::Variable)
          continue; // belongs to another ball's program, and its verdict reports it
        const bool of_course = one->word == Word::Inside || one->word == Word::Stay;
        if (of_course ? file.file.course && !file.course // the course's finding already says so
                      : own == nullptr || !own->problem.empty())
          continue;
        const auto found = look_up_alone(*one, file, own == nullptr ? none : *own);
        if (found.rule != nullptr)
          file.file.diagnostics.push_back(
              finding(*found.rule, one->name.text.empty() ? whole.span : one->name.span,
                      found.meaning.problem, found.help));
      }
  }
  sort_by_place(file.file.diagnostics);
}

void check_files(SuiteFile& file, structured::Files& files) {
  for (const auto& with : file.file.with)
    if (const auto path = structured::resolve_path(file.source->name(), with.text);
        !with.text.empty() && !files.read(path))
      file.file.diagnostics.push_back(cannot_read("with", with, path, endings, files));
}

/// Reads the course named in a file.
void read_course(SuiteFile& file, structured::Files& files) {
  const auto& given = file.file.course;
  if (!given || given->text.empty())
    return;
  const auto path = structured::resolve_path(file.source->name(), given->text);
  auto& findings = file.file.diagnostics;
  auto text = files.read(path);
  if (!text) {
    findings.push_back(cannot_read("course", *given, path, {&report::course_ending, 1}, files));
    return;
  }
  const Source drawing(path, *std::move(text));
  auto reading = report::read_course(drawing);
  const auto wrong = std::find_if(reading.findings.begin(), reading.findings.end(), is_error);
  if (wrong == reading.findings.end()) {
    for (auto& one : reading.findings)
      if (one.rule == &report::rules::CourseNarrow)
        findings.push_back(
            finding(rules::WallAtStart, given->span, std::move(one.message), std::move(one.help)));
    file.course = std::make_unique<report::Course>(std::move(reading.course));
    return;
  }
  const auto place = drawing.position(wrong->span.begin);
  findings.push_back(
      finding(rules::File, given->span,
              texts::CourseHasErrors(fmt::format("{}:{}:{}", path, place.line, place.column),
                                     wrong->message),
              texts::CheckListsAll(path)));
}

/// Adds the groups of one file, for the given programs or for its own.
void add_groups(Suite& suite, SuiteReader& reader, std::size_t index, const SuiteOptions& options,
                const std::vector<std::size_t>& programs) {
  const auto& file = suite.files[index];
  for (std::size_t t = 0; t < file.file.tests.size(); ++t) {
    const auto& test = file.file.tests[t];
    if (!options.only.empty() && test.name.text != options.only)
      continue;
    for (const auto given : programs) {
      const auto program = reader.program_of(test, given, file);
      Group group{index, t, program, options.seeds.value_or(test.seeds), suite.cases, {}, {}};
      for (const auto& ball : file.file.balls)
        group.room.push_back(reader.program_of(
            test,
            reader.program(structured::resolve_path(file.source->name(), ball.program.text), file),
            file));
      for (const auto& one : test.expectations) {
        const auto whose = one.ball ? group.room[*one.ball] : program;
        group.meanings.push_back(look_up(one, file, suite.programs[whose]));
      }
      suite.cases += group.seeds.count();
      suite.groups.push_back(std::move(group));
    }
  }
}

/// No test has the requested name.
Failure no_such_test(const Suite& suite, const std::string& name) {
  std::vector<std::string_view> known;
  for (const auto& file : suite.files)
    for (const auto& test : file.file.tests)
      known.push_back(test.name.text);
  const auto meant = closest(name, known);
  return {ExitCode::Usage, fmt::format("no test is called \"{}\"{}", name,
                                       meant ? fmt::format("; did you mean \"{}\"?", *meant) : "")};
}

} // namespace

compiler::Target target_of(const TestFile& file) {
  auto target = file.target;
  target.version = std::min(target.version, spec::info(file.firmware).language());
  return target;
}

bool SuiteFile::has_errors() const {
  return any_error(file.diagnostics);
}

bool Suite::has_errors() const {
  return std::any_of(files.begin(), files.end(),
                     [](const SuiteFile& file) { return file.has_errors(); });
}

tl::expected<Suite, Failure> make_suite(std::vector<GivenFile> given, const SuiteOptions& options,
                                        structured::Files& from) {
  Suite suite;
  suite.ball = options.ball;
  EachOnce files(from);
  std::vector<std::string> wanted;
  std::set<std::string> known;
  for (const auto& path : options.programs)
    if (known.insert(files.identity(path)).second)
      wanted.push_back(path);
  SuiteReader reader(suite, files, options);
  std::vector<std::vector<std::size_t>> programs;
  for (auto& one : given) {
    SuiteFile file;
    file.source = std::make_unique<Source>(std::move(one.name), std::move(one.text));
    file.file = parse(*file.source);
    check_files(file, files);
    read_course(file, files);
    check_room(file, files);
    auto& own = programs.emplace_back();
    if (options.programs.empty())
      if (const auto path = program_path(file, files))
        own.push_back(reader.program(*path, file));
    for (const auto& path : wanted) {
      if (!file.file.balls.empty())
        return tl::unexpected(
            Failure{ExitCode::Usage, fmt::format("{} tests a room, which names its own programs; "
                                                 "omit `--program`",
                                                 file.source->name())});
      own.push_back(reader.program(path, file));
    }
    const bool named = options.programs.empty() && !own.empty();
    if (named && suite.programs[own.front()].is_javascript())
      check_javascript(file, suite.programs[own.front()].name);
    check_names(file, suite, reader, named ? std::optional(own.front()) : std::nullopt);
    suite.files.push_back(std::move(file));
  }
  for (std::size_t i = 0; i < suite.files.size(); ++i)
    add_groups(suite, reader, i, options, programs[i]);
  if (!options.only.empty() && suite.groups.empty() && !suite.has_errors())
    return tl::unexpected(no_such_test(suite, options.only));
  return suite;
}

bool is_test(std::string_view file_name) {
  return has_ending(file_name, file_ending);
}

bool is_javascript(std::string_view file_name) {
  return has_ending(file_name, endings.back());
}

bool is_no_program(std::string_view file_name) {
  return report::is_course(file_name) || is_test(file_name);
}

std::vector<Diagnostic> check(const Source& source, structured::Files& files) {
  auto suite = make_suite({{source.name(), std::string(source.text())}}, {}, files);
  if (!suite)
    return {};
  if (!suite->groups.empty())
    check_meant(suite->files.front(), suite->programs[suite->groups.front().program]);
  auto& found = suite->files.front().file.diagnostics;
  for (auto& one : found)
    one.severity = one.rule->severity;
  return std::move(found);
}

void check_tests(std::span<const run::SourceFile> sources, std::vector<FileFindings>& found,
                 structured::Files& files) {
  for (const auto& source : sources) {
    const auto file = std::find_if(found.begin(), found.end(), [&](const FileFindings& one) {
      return is_test(source.path) && one.source == &source.source;
    });
    if (file != found.end())
      file->diagnostics = check(source.source, files);
  }
}

} // namespace orb::testing
