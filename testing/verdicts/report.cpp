#include "testing/verdicts/report.h"

#include "base/text/text.h"
#include "base/text/utf8.h"
#include "report/page.h"
#include "report/svg.h"
#include "testing/run_suite.h"
#include "testing/texts.h"
#include "testing/verdicts/pupils.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/table.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <vector>

namespace orb::testing {

const std::string_view report_mark = "<!doctype html><!-- a report of orb test -->\n";

namespace {

// More would not be looked at, and a replay takes some hundred kilobytes.
constexpr std::size_t most_pictures = 500;
constexpr std::size_t most_replays = 100;

constexpr std::string_view style = R"css(
:root{color-scheme:light dark;--ink:#14212b;--paper:#fff;--card:#f3f7f9;--good:#1a7f37;--bad:#b3261e;--dim:#536472}
@media (prefers-color-scheme:dark){:root{--ink:#e4ecf1;--paper:#0b1014;--card:#161f27;--good:#4fc46b;--bad:#ff8a7f;--dim:#91a2af}}
body{font:15px/1.45 system-ui,sans-serif;color:var(--ink);background:var(--paper);margin:2rem auto;max-width:72rem;padding:0 1rem}
h1{font-size:1.4rem}h2{font-size:1.05rem;margin:2rem 0 .5rem}
table{border-collapse:collapse;margin:1rem 0;display:block;overflow-x:auto}td,th{padding:.25rem .7rem;text-align:left;border-bottom:1px solid var(--card)}
.runs{display:grid;grid-template-columns:repeat(auto-fill,minmax(15rem,1fr));gap:1rem}
.run{background:var(--card);border-radius:.6rem;padding:.7rem;overflow-wrap:anywhere}
.run img{width:100%;height:auto;display:block;border-radius:.4rem}
.run p{margin:.4rem 0 0}.seen,.dim{color:var(--dim)}code{font-size:.85em}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(10rem,1fr));gap:.8rem}
.pupil{background:var(--card);border-radius:.6rem;padding:.5rem;overflow-wrap:anywhere;border-left:.3rem solid var(--good)}
.pupil.failed{border-left-color:var(--bad)}.pupil img,.pupil .none{width:100%;aspect-ratio:1;object-fit:contain;display:block;border-radius:.4rem}
.pupil .none{display:grid;place-items:center;color:var(--dim);margin:0}.pupil p{margin:.3rem 0 0}
.marks span{margin-right:.5rem}.marks a{text-decoration:none}summary{cursor:pointer;font-weight:600;margin:2rem 0 0}
.passed{color:var(--good)}.failed,.error{color:var(--bad)}.run.failed{outline:2px solid var(--bad)}.run,.pupil,.run.failed,.pupil.failed,.run.passed,.pupil.passed{color:inherit}
a{color:inherit}pre{white-space:pre-wrap;font-size:.85em;margin:.4rem 0 0}
)css";

std::vector<report::RoomRun> room_of(const Footage& footage) {
  std::vector<report::RoomRun> balls;
  for (const auto& ball : footage)
    balls.push_back({ball.name, &ball.journey});
  return balls;
}

bool is_room(const Footage& footage) {
  return !footage.front().name.empty();
}

std::string drawing(const Footage& footage) {
  return is_room(footage) ? report::room_svg(room_of(footage))
                          : report::path_svg(footage.front().journey);
}

std::string replay_page(const Footage& footage, std::string_view title) {
  return is_room(footage) ? report::room_page(room_of(footage), title)
                          : report::report_page(footage.front().journey, title);
}

Message called(Verdict verdict) {
  return verdict == Verdict::Passed   ? texts::Passed()
         : verdict == Verdict::Failed ? texts::Failed()
                                      : texts::Error();
}

Message runs(std::uint64_t n) {
  return counted(n, texts::OneRun, texts::Runs);
}

/// The results of a program in all its tests.
struct Pupil {
  std::string picture; ///< of its first failed run, or else of its first run
  std::string page;    ///< target of the picture's link
  std::string own;     ///< page to hand back
};

class Report {
public:
  Report(const Suite& suite, const Results& results, Pages& pages,
         const std::map<std::string, std::string>& names, const Speech& speech)
      : suite_(suite), results_(results), pages_(pages), names_(names), speech_(speech) {}

  bool write() {
    std::string failed;
    std::string passed;
    std::size_t passes = 0;
    for (const auto wanted : {Verdict::Error, Verdict::Failed, Verdict::Passed})
      for (std::size_t i = 0; i < results_.groups.size(); ++i) {
        const auto& group = results_.groups[i];
        if (group.cases.empty() || group.verdict() != wanted)
          continue;
        passes += wanted == Verdict::Passed ? 1 : 0;
        if (!add_group(i, wanted == Verdict::Passed ? passed : failed))
          return false;
      }
    const auto table = table_of(results_);
    if (!write_pupils(table))
      return false;
    const auto summary = escape_markup(render_summary(results_, speech_.say));
    auto page = fmt::format("{}<html lang=\"{}\"><head><meta charset=\"utf-8\">"
                            "<meta name=\"viewport\" content=\"width=device-width\">"
                            "<title>{}</title><style>{}</style></head>\n<body>\n<h1>{}</h1>\n",
                            report_mark, speech_.code, summary, style, summary);
    page += draw(table) + failed;
    if (!passed.empty())
      page += fmt::format("<details{}><summary>{}</summary>\n{}</details>\n",
                          failed.empty() ? " open" : "",
                          say(counted(passes, texts::OnePassed, texts::SomePassed)), passed);
    if (left_out_ > 0)
      page += fmt::format("<p class=\"dim\">{}</p>\n", say(texts::WithoutPicture(runs(left_out_))));
    return pages_.write("index.html", page + "</body></html>\n");
  }

private:
  std::string say(const Message& message) const { return escape_markup(speech_.say(message)); }
  /// Translates a title, for which a lesson may have a translation.
  std::string say_title(const std::string& title) const { return say(Message::as_is(title)); }

  /// What was tested: a program, or all programs of a room.
  std::string subject(const Group& group, const GroupResult& told) const {
    return group.room.empty() ? told.program : speech_.say(texts::Room(group.room.size()));
  }

  std::string name_of(const Table::Row& row) const {
    const auto known = names_.find(row.program);
    return known == names_.end() ? row.program : known->second;
  }

  /// Writes a page for each pupil, and certificates for those who passed.
  bool write_pupils(const Table& table) {
    std::vector<std::string> passed;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const auto& row = table.rows[i];
      const auto page = fmt::format("pupils/{:06}.html", i);
      if (!pages_.write(page, pupil_page(name_of(row), row, shown_, speech_)))
        return false;
      pupils_[row.program].own = page;
      const bool all = std::all_of(row.cells.begin(), row.cells.end(), [](const auto* cell) {
        return cell != nullptr && !cell->cases.empty() && cell->verdict() == Verdict::Passed;
      });
      if (all)
        passed.push_back(name_of(row));
    }
    certified_ = !passed.empty();
    return passed.empty() ||
           pages_.write("certificates.html", certificates(passed, table, speech_));
  }

  /// Draws one field per pupil, fewest points first, and below it the results.
  std::string draw(const Table& table) const {
    if (table.rows.empty())
      return {};
    std::vector<const Table::Row*> rows;
    for (const auto& row : table.rows)
      rows.push_back(&row);
    std::stable_sort(rows.begin(), rows.end(), [&](const auto* a, const auto* b) {
      const bool one = failed(*a);
      const bool other = failed(*b);
      return one != other ? one : a->points * b->points_of < b->points * a->points_of;
    });
    std::string out = "<div class=\"grid\">\n";
    for (const auto* row : rows)
      out += field(*row);
    out += "</div>\n";
    if (certified_)
      out +=
          fmt::format("<p><a href=\"certificates.html\">{}</a></p>\n", say(texts::Certificates()));
    out += fmt::format("<table>\n<tr><th>{}</th>", say(texts::Program()));
    for (const auto& test : table.tests)
      out += fmt::format("<th>{}</th>", say_title(test));
    out += fmt::format("<th>{}</th></tr>\n", say(texts::Points()));
    for (const auto* row : rows) {
      out += fmt::format("<tr><td><a href=\"{}\">{}</a></td>", pupils_.at(row->program).own,
                         escape_markup(row->program));
      for (const auto* cell : row->cells)
        out += mark(cell, "td", cell == nullptr ? "" : say(called(cell->verdict())));
      out += fmt::format("<td>{}/{}</td></tr>\n", row->points, row->points_of);
    }
    return out + "</table>\n";
  }

  static bool failed(const Table::Row& row) {
    return std::any_of(row.cells.begin(), row.cells.end(), [](const auto* cell) {
      return cell != nullptr && !cell->cases.empty() && cell->verdict() != Verdict::Passed;
    });
  }

  /// A result that links to its details.
  std::string mark(const GroupResult* cell, std::string_view element, std::string_view text) const {
    if (cell == nullptr || cell->cases.empty())
      return fmt::format("<{0}></{0}>", element);
    return fmt::format("<{0} class=\"{1}\"><a href=\"#g{2}\" title=\"{3}\">{4}</a></{0}>", element,
                       to_string(cell->verdict()), cell->first, say_title(cell->test), text);
  }

  std::string field(const Table::Row& row) const {
    const auto& pupil = pupils_.at(row.program);
    auto out = fmt::format("<div class=\"pupil {}\">", failed(row) ? "failed" : "passed");
    if (pupil.picture.empty())
      out += fmt::format("<p class=\"none\">{}</p>", say(texts::NoRun()));
    else
      out += fmt::format("<a href=\"{}\"><img src=\"{}\" alt=\"{}\" loading=\"lazy\"></a>",
                         pupil.page, pupil.picture, say(texts::PathOfBall()));
    out += fmt::format("<p><a href=\"{}\"><b>{}</b></a> {}/{}</p><p class=\"marks\">", pupil.own,
                       escape_markup(name_of(row)), row.points, row.points_of);
    for (const auto* cell : row.cells)
      out +=
          mark(cell, "span",
               cell != nullptr && !cell->cases.empty() && cell->verdict() == Verdict::Passed ? "✓"
                                                                                             : "✗");
    return out + "</p></div>\n";
  }

  bool add_group(std::size_t index, std::string& body) {
    const auto& told = results_.groups[index];
    const auto verdict = told.verdict();
    body += fmt::format(
        "<h2 id=\"g{}\"><span class=\"{}\">{}</span> {}, {} <span class=\"dim\">{}:{}"
        "</span></h2>\n",
        told.first, to_string(verdict), say(called(verdict)), say_title(told.test),
        escape_markup(subject(suite_.groups[index], told)), escape_markup(told.file), told.line);
    // All runs of a program that cannot run fail with the same words.
    const auto* failure = first_failure(told);
    if (failure != nullptr && failure->verdict == Verdict::Error) {
      body += once_.is_new(told, *failure)
                  ? fmt::format("<pre>{}</pre>\n", escape_markup(failure->problem))
                  : fmt::format("<p class=\"dim\">{}</p>\n", say(texts::AsAbove()));
      return true;
    }
    body += "<div class=\"runs\">\n";
    std::uint64_t omitted = 0;
    for (const bool passed : {false, true})
      for (const auto& one : told.cases) {
        omitted += !passed && one.omitted ? 1 : 0;
        if ((one.verdict == Verdict::Passed) == passed && !one.omitted &&
            !add_case(suite_.groups[index], told, one, body))
          return false;
      }
    body += "</div>\n";
    if (omitted > 0)
      body += fmt::format("<p class=\"dim\">{}</p>\n", say(texts::FailedToo(runs(omitted))));
    return true;
  }

  bool add_case(const Group& group, const GroupResult& told, const CaseResult& one,
                std::string& body) {
    const auto number = told.first + one.seed - group.seeds.first;
    const auto name = fmt::format("runs/{:06}", number);
    const bool failed = one.verdict == Verdict::Failed;
    if (pictures_ >= most_pictures && !(failed && replays_ < most_replays)) {
      ++left_out_;
      if (failed)
        body += card(one, {}, {});
      return true;
    }
    Footage virtual_run;
    if (one.footage == nullptr)
      run_case(suite_, group, one.seed, nullptr, &virtual_run);
    const auto& footage = one.footage == nullptr ? virtual_run : *one.footage;
    ++pictures_;
    const auto picture = name + ".svg";
    const auto drawn = drawing(footage);
    if (!pages_.write(picture, drawn))
      return false;
    std::string replay;
    if (failed && replays_ < most_replays) {
      ++replays_;
      replay = name + ".html";
      const auto title = fmt::format("{}: {}, seed {}", subject(group, told), told.test, one.seed);
      if (!pages_.write(replay, replay_page(footage, title)))
        return false;
    }
    shown_.try_emplace(&told, Shown{drawn, replay});
    auto& pupil = pupils_[told.program];
    if (pupil.picture.empty())
      pupil = {picture, replay.empty() ? fmt::format("#g{}", told.first) : replay, {}};
    body += card(one, picture, replay);
    return true;
  }

  std::string card(const CaseResult& one, const std::string& picture,
                   const std::string& replay) const {
    auto out = fmt::format("<div class=\"run {}\">", to_string(one.verdict));
    if (!replay.empty())
      out += fmt::format("<a href=\"{}\">", replay);
    if (!picture.empty())
      out += fmt::format("<img src=\"{}\" alt=\"{}\" loading=\"lazy\">", picture,
                         say(texts::PathOfBall()));
    if (!replay.empty())
      out += "</a>";
    out += fmt::format("<p><b class=\"{}\">{}</b> {}, {}", to_string(one.verdict),
                       say(called(one.verdict)), say(texts::Seed(one.seed)), words(one.lasted));
    out += replay.empty()
               ? "</p>"
               : fmt::format(" · <a href=\"{}\">{}</a></p>", replay, say(texts::Replay()));
    for (const auto& miss : one.misses)
      out += fmt::format("<p><code>{}</code><br><span class=\"seen\">{}</span></p>",
                         escape_markup(miss.expected), say(miss.seen));
    if (!one.again.empty())
      out += fmt::format("<p><code>{}</code></p>", escape_markup(one.again));
    if (!one.problem.empty())
      out += fmt::format("<pre>{}</pre>", escape_markup(one.problem));
    return out + "</div>\n";
  }

  const Suite& suite_;
  const Results& results_;
  Pages& pages_;
  const std::map<std::string, std::string>& names_;
  const Speech& speech_;
  std::map<std::string, Pupil> pupils_; ///< by program
  std::map<const GroupResult*, Shown> shown_;
  bool certified_ = false;
  ToldOnce once_;
  std::size_t pictures_ = 0;
  std::size_t replays_ = 0;
  std::uint64_t left_out_ = 0;
};

} // namespace

bool write_report(const Suite& suite, const Results& results, Pages& pages,
                  const std::map<std::string, std::string>& names, const Speech& speech) {
  return Report(suite, results, pages, names, speech).write();
}

} // namespace orb::testing
