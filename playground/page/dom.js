// Shared by the modules of the page.

export const $ = id => document.getElementById(id);

/**
 * Translates an English text to the page's language. Shown text is translated automatically (translate.js): use
 * this only for texts that are taken apart first.
 */
export let t = text => text;
export const speak_with = say => { t = say; };

export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value !== false && value !== undefined) made.setAttribute(key, value === true ? "" : value);
  made.append(...children);
  return made;
}
export const button = (words, on_click, attributes = {}) => element("button", { type: "button", onclick: on_click, ...attributes }, words);

/** Turns text between backticks into code elements. It follows changes of the page's language. */
export function with_code(text) {
  const made = element("span", { "data-said": text });
  fill_said(made);
  return made;
}
const fill_said = made => made.replaceChildren(...t(made.dataset.said).split(/`([^`\n]+)`/).map((part, i) => i % 2 ? element("code", {}, part) : part));
export const say_anew = () => { for (const made of document.querySelectorAll("[data-said]")) fill_said(made); };

/** Shows words in the line below the program; screen readers announce them. */
export function say(words, look = "") {
  $("status").textContent = words;
  $("status").className = look;
}

export const close_dialogs = () => { for (const open of document.querySelectorAll("dialog[open]")) open.close(); };

/** Copies the text of a field and selects it. */
export async function copy(field, text = field.value) {
  field.select();
  try { await navigator.clipboard.writeText(text); } catch { document.execCommand("copy"); }
}

/** For an import that fails without a network. */
export const not_here = () => { throw new Error("this part of the page is not on this device yet: connect to the network once"); };
/** Loads a rarely used part on demand, once. */
export function on_demand(load) {
  let loaded = null;
  return async deed => {
    let part;
    try {
      part = await (loaded ??= load());
    } catch {
      loaded = null;
      return say("This part of the page could not be loaded. Check your network connection and reload the page.", "bad");
    }
    return deed(part);
  };
}

/** Shows a bar above the page until the trouble is over. */
export function show_trouble(id, words) {
  $(id).firstElementChild.textContent = words;
  $(id).hidden = !words;
}

let announced = 0, unsaid = "";
/** Announces words to screen readers; joins those in quick succession. */
export function announce(words) {
  unsaid = `${unsaid}${words}`.slice(-300);
  if (announced) return;
  announced = setTimeout(() => {
    announced = 0;
    $("announce").textContent = unsaid.trim();
    unsaid = "";
  }, 700);
}

export function download(name, content, type = "text/plain") {
  const link = element("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

const allowed = new Set("A B BLOCKQUOTE BR CODE DEL DETAILS EM H1 H2 H3 H4 HR I LI OL P PRE S STRONG SUMMARY TABLE TBODY TD TH THEAD TR UL".split(" "));
/** Removes everything from HTML but plain markup: no attributes, and only links to the web and within the page. */
export function harmless(html) {
  const page = new DOMParser().parseFromString(html, "text/html");
  for (const node of [...page.body.querySelectorAll("*")]) {
    if (!allowed.has(node.nodeName)) {
      node.replaceWith(page.createTextNode(node.textContent));
      continue;
    }
    for (const { name, value } of [...node.attributes])
      if (!(node.nodeName === "A" && name === "href" && /^(https:|#|docs\/)/.test(value))) node.removeAttribute(name);
  }
  return page.body.innerHTML;
}
