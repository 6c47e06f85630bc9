#include "testing/verdicts/report.h"

#include "base/text.h"
#include "base/utf8.h"
#include "report/page.h"
#include "report/svg.h"
#include "testing/run_suite.h"
#include "testing/verdicts/render.h"
#include "testing/verdicts/table.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::testing {

const std::string_view report_mark = "<!doctype html><!-- a report of orb test -->\n";

namespace {

// A page that shows more helps nobody, and a replay takes some hundred kilobytes.
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
.passed{color:var(--good)}.failed,.error{color:var(--bad)}.run.failed,.run.error{outline:2px solid var(--bad);color:inherit}
a{color:inherit}pre{white-space:pre-wrap;font-size:.85em;margin:.4rem 0 0}
)css";

class Report {
public:
  Report(const Suite& suite, const Results& results, Pages& pages)
      : suite_(suite), results_(results), pages_(pages) {}

  bool write() {
    std::string body;
    for (std::size_t i = 0; i < results_.groups.size(); ++i)
      if (!results_.groups[i].cases.empty() && !add_group(i, body))
        return false;
    auto page = fmt::format("{}<html lang=\"en\"><head><meta charset=\"utf-8\">"
                            "<meta name=\"viewport\" content=\"width=device-width\">"
                            "<title>{}</title><style>{}</style></head>\n<body>\n<h1>{}</h1>\n",
                            report_mark, escape_markup(render_summary(results_)), style,
                            escape_markup(render_summary(results_)));
    page += table() + body;
    if (left_out_ > 0)
      page +=
          fmt::format("<p class=\"dim\">Without a picture: {}.</p>\n", plural(left_out_, "run"));
    return pages_.write("index.html", page + "</body></html>\n");
  }

private:
  std::string table() const {
    const auto table = table_of(results_);
    if (table.rows.empty())
      return {};
    std::string out = "<table>\n<tr><th>program</th>";
    for (const auto& test : table.tests)
      out += fmt::format("<th>{}</th>", escape_markup(test));
    out += "<th>points</th></tr>\n";
    for (const auto& row : table.rows) {
      out += fmt::format("<tr><td>{}</td>", escape_markup(row.program));
      for (const auto* cell : row.cells) {
        if (cell == nullptr || cell->cases.empty()) {
          out += "<td></td>";
          continue;
        }
        const auto word = to_string(cell->verdict());
        out += fmt::format("<td class=\"{0}\"><a href=\"#g{1}\">{0}</a></td>", word, cell->first);
      }
      out += fmt::format("<td>{}/{}</td></tr>\n", row.points, row.points_of);
    }
    return out + "</table>\n";
  }

  bool add_group(std::size_t index, std::string& body) {
    const auto& told = results_.groups[index];
    const auto word = to_string(told.verdict());
    body +=
        fmt::format("<h2 id=\"g{}\"><span class=\"{}\">{}</span> {}, {} <span class=\"dim\">{}:{}"
                    "</span></h2>\n<div class=\"runs\">\n",
                    told.first, word, word, escape_markup(told.test), escape_markup(told.program),
                    escape_markup(told.file), told.line);
    for (const auto& one : told.cases)
      if (!add_case(suite_.groups[index], told, one, body))
        return false;
    body += "</div>\n";
    return true;
  }

  bool add_case(const Group& group, const GroupResult& told, const CaseResult& one,
                std::string& body) {
    const auto number = told.first + one.seed - group.seeds.first;
    const auto name = fmt::format("runs/{:06}", number);
    const bool failed = one.verdict == Verdict::Failed;
    const bool pictured = one.verdict != Verdict::Error &&
                          (pictures_ < most_pictures || (failed && replays_ < most_replays));
    std::string replay;
    if (pictured) {
      report::Journey journey;
      run_case(suite_, group, one.seed, nullptr, &journey);
      ++pictures_;
      if (!pages_.write(name + ".svg", report::path_svg(journey)))
        return false;
      if (failed && replays_ < most_replays) {
        ++replays_;
        replay = name + ".html";
        const auto title = fmt::format("{}: {}, seed {}", told.program, told.test, one.seed);
        if (!pages_.write(replay, report::report_page(journey, title)))
          return false;
      }
    } else if (!failed && one.verdict != Verdict::Error) {
      ++left_out_;
      return true;
    }
    body += card(one, pictured ? name + ".svg" : std::string(), replay);
    return true;
  }

  static std::string card(const CaseResult& one, const std::string& picture,
                          const std::string& replay) {
    auto out = fmt::format("<div class=\"run {}\">", to_string(one.verdict));
    if (!replay.empty())
      out += fmt::format("<a href=\"{}\">", replay);
    if (!picture.empty())
      out += fmt::format("<img src=\"{}\" alt=\"the way of the ball\" loading=\"lazy\">", picture);
    if (!replay.empty())
      out += "</a>";
    out += fmt::format("<p><b class=\"{0}\">{0}</b> seed {1}, {2}", to_string(one.verdict),
                       one.seed, words(one.lasted));
    out += replay.empty() ? "</p>" : fmt::format(" · <a href=\"{}\">replay</a></p>", replay);
    for (const auto& miss : one.misses)
      out += fmt::format("<p><code>{}</code><br><span class=\"seen\">{}</span></p>",
                         escape_markup(miss.expected), escape_markup(miss.seen));
    if (!one.again.empty())
      out += fmt::format("<p><code>{}</code></p>", escape_markup(one.again));
    if (!one.problem.empty())
      out += fmt::format("<pre>{}</pre>", escape_markup(one.problem));
    return out + "</div>\n";
  }

  const Suite& suite_;
  const Results& results_;
  Pages& pages_;
  std::size_t pictures_ = 0;
  std::size_t replays_ = 0;
  std::uint64_t left_out_ = 0;
};

} // namespace

bool write_report(const Suite& suite, const Results& results, Pages& pages) {
  return Report(suite, results, pages).write();
}

} // namespace orb::testing
