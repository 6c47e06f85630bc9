// Builds a site from the pages below docs/; the programs in them open in the playground.

import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join, posix, relative } from "node:path";
import { deflateRawSync } from "node:zlib";
import MarkdownIt from "markdown-it";

const learn = ["examples/lessons/README.md", ...["structured", "language", "macros", "courses", "rooms", "testing", "debugging", "gallery", "playground"]
  .map(name => `docs/using/${name}.md`), "docs/reference/cheatsheet.md"];
const shelves = { Use: /^docs\/(using|editors)\//, Reference: /^docs\/reference\//, Inside: /^docs\/(inside\/|architecture)/ };
const endings = { orb: "orb", basic: "bas", macro: "macro", test: "test" };

/** The page for a text of the checkout: docs/using/ball.md is using/ball.html, README.md index.html. */
function page_of(path) {
  const inside = path.replace(/^docs\//, "").replace(/^examples\//, "");
  return inside.replace(/(^|\/)README\.md$/, "$1index.html").replace(/\.md$/, ".html");
}
const slug = text => text.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").trim().replace(/\s/g, "-");
const address = files => {
  const data = JSON.stringify({ files, active: Object.keys(files)[0] });
  return `#p=${deflateRawSync(data, { level: 9 }).toString("base64url")}`;
};

class Pages {
  constructor(root, out) {
    this.root = root;
    this.out = out;
    // The navigation replaces docs/README.md; the README takes its place.
    this.sources = ["README.md", "examples/lessons/README.md", ...this.below("docs").filter(path => path !== "docs/README.md")].filter(path => existsSync(join(root, path)));
    for (const lesson of readdirSync(join(root, "examples/lessons")).sort())
      if (existsSync(join(root, "examples/lessons", lesson, "README.md"))) this.sources.push(`examples/lessons/${lesson}/README.md`);
    this.titles = new Map(this.sources.map(path => [path, (/^#\s+(.+)$/m.exec(this.read(path))?.[1] ?? basename(path)).replaceAll("`", "")]));
    this.assets = new Set();
    this.markdown = new MarkdownIt({ html: false, linkify: false, typographer: false });
    this.set_rules();
  }
  read(path) { return readFileSync(join(this.root, path), "utf8"); }
  below(folder) {
    return readdirSync(join(this.root, folder), { withFileTypes: true }).flatMap(entry =>
      entry.isDirectory() ? this.below(`${folder}/${entry.name}`) : entry.name.endsWith(".md") ? [`${folder}/${entry.name}`] : []).sort();
  }
  /** The target of a link on the page `from`; null if it is not part of the site. */
  target(from, link) {
    if (/^(https?:|mailto:|#)/.test(link)) return link;
    const [path, anchor] = link.split("#");
    const wanted = posix.normalize(posix.join(posix.dirname(from), path)).replace(/\/$/, "");
    const here = posix.dirname(page_of(from));
    const to = page => posix.relative(here, page) + (anchor ? `#${anchor}` : "");
    const source = [wanted, `${wanted}/README.md`].find(one => this.titles.has(one));
    if (source) return to(page_of(source));
    if (/^examples\/(demo\/)?[\w-]+\.(bas|orb|macro)$/.test(wanted)) return `${posix.relative(here, "..")}/index.html#example=${basename(wanted)}`;
    if (/\.(svg|png)$/.test(wanted) && existsSync(join(this.root, wanted))) {
      this.assets.add(wanted);
      return to(wanted.replace(/^docs\//, ""));
    }
    return null;
  }
  set_rules() {
    const { rules } = this.markdown.renderer;
    const plain = (tokens, i, options, env, self) => self.renderToken(tokens, i, options);
    rules.heading_open = (tokens, i, options, env, self) => {
      const id = slug(tokens[i + 1].children.filter(one => one.type === "text" || one.type === "code_inline").map(one => one.content).join(""));
      const count = env.ids.get(id) ?? 0;
      env.ids.set(id, count + 1);
      tokens[i].attrSet("id", count ? `${id}-${count}` : id);
      return plain(tokens, i, options, env, self);
    };
    rules.link_open = (tokens, i, options, env, self) => {
      const target = this.target(env.path, tokens[i].attrGet("href"));
      env.links.push(target !== null);
      if (target === null) return "";
      tokens[i].attrSet("href", target);
      return plain(tokens, i, options, env, self);
    };
    rules.link_close = (tokens, i, options, env, self) => env.links.pop() ? plain(tokens, i, options, env, self) : "";
    const image = rules.image;
    rules.image = (tokens, i, options, env, self) => {
      tokens[i].attrSet("src", this.target(env.path, tokens[i].attrGet("src")) ?? "");
      tokens[i].attrSet("loading", "lazy");
      return image(tokens, i, options, env, self);
    };
    rules.table_open = () => '<div class="wide"><table>\n';
    rules.table_close = () => "</table></div>\n";
    rules.fence = (tokens, i, options, env) => this.fence(tokens[i], env);
  }
  fence({ info, content }, env) {
    const language = info.trim().split(/\s/)[0], ending = endings[language];
    const code = `<pre tabindex="0"><code>${this.markdown.utils.escapeHtml(content)}</code></pre>`;
    const named = env.names.shift();
    if (named) env.files[named] = content;
    if (!ending) return `${code}\n`;
    const name = named ?? `${/numbered|orbbasic/.test(info) ? "program" : "example"}.${ending}`;
    // A test opens with the program above it.
    const beside = ending === "test" ? Object.keys(env.files).filter(one => one !== name && one.split(".")[0] === name.split(".")[0]) : [];
    const files = Object.fromEntries([name, ...beside].map(one => [one, env.files[one] ?? content]));
    const home = `${posix.relative(posix.dirname(page_of(env.path)), "..")}/index.html`;
    return `<div class="program">${code}<a class="open-it" href="${home}${address(files)}">Open in the playground</a></div>\n`;
  }
  render(path) {
    const text = this.read(path);
    // Comments before blocks are instructions for tests; here they give file names.
    const names = [];
    let name = null, inside = false;
    const kept = text.split("\n").filter(line => {
      if (/^\s*```/.test(line)) {
        if (!inside) { names.push(name); name = null; }
        inside = !inside;
        return true;
      }
      const file = !inside && /^<!-- file: (\S+) -->$/.exec(line);
      if (file) name = file[1];
      return inside || !/^<!--.*-->$/.test(line);
    }).join("\n");
    const env = { path, names, files: {}, links: [], ids: new Map() };
    return this.markdown.render(kept, env);
  }
  navigation(path) {
    const here = posix.dirname(page_of(path));
    const link = one => `<li><a href="${posix.relative(here, page_of(one))}"${one === path ? ' aria-current="page"' : ""}>${this.markdown.utils.escapeHtml(this.titles.get(one))}</a></li>`;
    const on = shelf => this.sources.filter(one => shelf.test(one) && !learn.includes(one));
    const all = [["Learn", learn], ...Object.entries(shelves).map(([title, shelf]) => [title, on(shelf)])];
    return all.map(([title, list]) => `<h2>${title}</h2><ul>${list.filter(one => this.titles.has(one)).map(link).join("")}</ul>`).join("");
  }
  page(path) {
    const up = posix.relative(posix.dirname(page_of(path)), "..") || ".";
    const title = this.markdown.utils.escapeHtml(this.titles.get(path));
    const own = posix.relative(posix.dirname(page_of(path)), ".") || ".";
    const lesson = /^examples\/lessons\/([\w-]+)\/README\.md$/.exec(path)?.[1];
    const start = lesson ? `<p><a class="open-it" href="${up}/index.html#lesson=lessons/${lesson}">Do this lesson in the playground</a></p>` : "";
    return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'self'; img-src 'self'; base-uri 'none'; form-action 'none'">
<link rel="icon" href="${up}/icon.svg">
<link rel="stylesheet" href="${own}/docs.css">
<title>${title} · orb</title>
</head>
<body>
<header><a href="${own}/index.html"><b>orb</b></a> <a href="#pages" class="narrow">All pages</a> <a href="${up}/index.html">Playground</a></header>
<div class="columns">
<nav id="pages" aria-label="Docs">${this.navigation(path)}</nav>
<main>${start}
${this.render(path)}</main>
</div>
</body>
</html>
`;
  }
  write() {
    rmSync(this.out, { recursive: true, force: true });
    const put = (page, text) => {
      mkdirSync(dirname(join(this.out, page)), { recursive: true });
      writeFileSync(join(this.out, page), text);
    };
    for (const path of this.sources) put(page_of(path), this.page(path));
    for (const asset of this.assets) {
      const to = join(this.out, relative("docs", asset));
      mkdirSync(dirname(to), { recursive: true });
      copyFileSync(join(this.root, asset), to);
    }
    copyFileSync(join(this.root, "playground/site/docs.css"), join(this.out, "docs.css"));
  }
}
export const build_docs = (root, out) => new Pages(root, out).write();
