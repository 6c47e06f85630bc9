// Saved work: each opened program has a place in this browser, with its earlier versions.

import { openDB } from "idb";
import { checked } from "./workspace.js";

/** How many versions of a document to keep. */
export const most_versions = 50;

const content = one => JSON.stringify([one?.files, one?.main, one?.run, one?.task ?? ""]);
const same = (one, other) => content(one) === content(other);
const is_full = error => error?.name === "QuotaExceededError";

export class Store {
  #db = null;

  /** Calls `on_trouble(words)` once if nothing can be saved. */
  constructor(on_trouble) {
    let told = false;
    this.trouble = error => {
      if (told) return;
      told = true;
      on_trouble(is_full(error)
        ? "This browser has no space left, so what you write from now on will not be kept: save it on this computer."
        : "This browser stores nothing for this page, perhaps because the window is private: save what you write on this computer.");
    };
  }
  async #open() {
    this.#db ??= openDB("orb-playground", 1, {
      upgrade(db) {
        db.createObjectStore("documents", { keyPath: "id" });
        db.createObjectStore("versions", { autoIncrement: true }).createIndex("document", "document");
      },
    });
    return this.#db;
  }
  /** Returns the result of `deed(db)`; undefined, after reporting it, if the browser cannot store data. */
  async #within(deed) {
    try {
      return await deed(await this.#open());
    } catch (error) {
      this.trouble(error);
      return undefined;
    }
  }

  /**
   * Saves a workspace under its document id. Before it is replaced by something else, and if `mark` is set, the
   * previous state becomes a version.
   */
  keep(workspace, mark = false) {
    const { document: id, title } = workspace, copy = structuredClone(workspace);
    if (!id) return Promise.resolve();
    return this.#within(async db => {
      const before = await db.get("documents", id);
      if (mark && before && !same(before.workspace, copy)) await this.#add_version(db, id, before);
      const row = { id, title, changed: Date.now(), workspace: copy };
      try {
        await db.put("documents", row);
        if (mark) await this.#add_version(db, id, row);
      } catch (error) {
        if (!is_full(error) || !await this.#make_room(db)) throw error;
        await db.put("documents", row);
      }
    });
  }
  async #add_version(db, id, { changed, workspace }) {
    const transaction = db.transaction("versions", "readwrite"), { store } = transaction;
    const keys = await store.index("document").getAllKeys(id);
    const last = keys.length ? await store.get(keys[keys.length - 1]) : null;
    if (!same(last?.workspace, workspace)) {
      await store.add({ document: id, changed, workspace });
      for (const key of keys.slice(0, Math.max(0, keys.length + 1 - most_versions))) await store.delete(key);
    }
    await transaction.done;
  }
  /** Deletes the older half of the versions. */
  async #make_room(db) {
    const keys = await db.getAllKeys("versions");
    for (const key of keys.slice(0, Math.ceil(keys.length / 2))) await db.delete("versions", key);
    return keys.length > 0;
  }

  /** The saved workspace of a document; null if there is none. */
  async find(id) {
    const row = await this.#within(db => db.get("documents", id));
    const found = row && checked(row.workspace);
    return found ? { ...found, document: id, title: row.title } : null;
  }
  /** All documents, most recently changed first: id, title, time of change. */
  async list() {
    const rows = await this.#within(db => db.getAll("documents")) ?? [];
    return rows.sort((a, b) => b.changed - a.changed).map(({ id, title, changed, workspace }) => ({ id, title, changed, workspace }));
  }
  /** The versions of a document, newest first. */
  async versions(id) {
    return (await this.#within(db => db.getAllFromIndex("versions", "document", id)) ?? []).reverse();
  }
}

/** A new unique name for a document. */
export const new_id = () => `own:${crypto.randomUUID?.() ?? `${Date.now()}-${Math.random()}`}`;
