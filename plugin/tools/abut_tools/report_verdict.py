# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a run ended: the head of its page."""

import fcntl
import re

from .report_page import number, pointer, quoted

# Status of run.json: class, word and what it means.
WORDS = {
    "solved": ("good", "SOLVED", "The run came to its end, without warnings."),
    "warning": ("warn", "SOLVED WITH WARNINGS",
                "The run came to its end. Read the warnings before the "
                "results are used."),
    "no answer": ("bad", "NO ANSWER",
                  "There is no answer to rely on. The figures below are for "
                  "the search for the cause only."),
    "input error": ("bad", "INPUT ERROR",
                    "The input has an error; nothing was solved."),
    "late error": ("bad", "INPUT ERROR",
                   "An error in the input ended the run. The figures below are "
                   "those of the part before it."),
    "failed": ("bad", "INTERNAL ERROR",
               "The program failed; this is a fault of the program or of the "
               "machine."),
    "stopped": ("cool", "STOPPED",
                "A signal stopped the run after a checkpoint. The same command "
                "with --resume continues it."),
    "running": ("cool", "RUNNING", "The run has not ended yet."),
    "killed": ("bad", "KILLED",
               "The run was killed, or the machine stopped, before it ended: "
               "there are no results."),
    "unknown": ("warn", "UNKNOWN",
                "run.json is missing: an older version of the program wrote "
                "this folder, and how the run ended is not known."),
}


class Verdict:
    """The verdict and its banner."""

    def __init__(self, run):
        self.run = run
        self.record = run.record
        self.has_results = run.is_finished
        self.status = self.find_status()
        self.tone, self.word, self.meaning = WORDS[self.status]

    def find_status(self):
        status = self.record.get("status", "unknown")
        if status == "unknown" and self.has_results:
            status = ("solved" if self.run.summary.get("converged")
                      else "no answer")
        if status == "running" and not is_locked(self.run.path):
            return "killed"
        if status == "input error" and self.has_results:
            return "late error"
        if status == "solved" and self.run.summary.get("warnings"):
            return "warning"
        return status if status in WORDS else "unknown"

    def banner(self):
        record = self.record
        code = record.get("exit_code")
        lines = [f'<header class="banner {self.tone}">',
                 f"<h1>{quoted(*self.run.title)}</h1>",
                 f'<div class="verdict">{self.word}'
                 + (f' <span class="soft">exit code '
                    f'{number(code, "run.json#/exit_code")}</span>'
                    if code is not None else "") + "</div>",
                 f'<p class="reason">{self.meaning}</p>']
        if record.get("error"):
            lines.append('<div class="message bad">'
                         + quoted(record["error"], "run.json#/error")
                         + "</div>")
        if self.has_results:
            lines += self.warnings()
        elif (self.run.path / "summary.json").is_file():
            lines.append('<p class="reason">summary.json in this folder is '
                         "of an earlier run and is not shown.</p>")
        if self.status == "killed" and (self.run.path / "checkpoint").exists():
            lines.append('<p class="reason">The folder has a checkpoint: the '
                         "same command with --resume continues from it.</p>")
        lines += [self.facts(), "</header>"]
        return "\n".join(lines)

    def warnings(self):
        """The warnings with the remedies of known failures."""
        summary = self.run.summary
        failures = summary.get("failures", {})
        tone = "bad" if self.status == "no answer" else "warn"
        lines = []
        for i, text in enumerate(summary.get("warnings", [])):
            code = re.match(r"(ABUT-F\d+): ", text)
            known = failures.get(code.group(1)) if code else None
            where = pointer("failures", code.group(1)) if known else ""
            lines.append(
                f'<div class="message {tone}">'
                + quoted(text, f"summary.json#/warnings/{i}")
                + ('<div class="cure">'
                   + quoted(known["name"], f"summary.json#{where}/name")
                   + "; cure: "
                   + quoted(known["remedy"], f"summary.json#{where}/remedy")
                   + f" (doc/failures.md, {code.group(1)})</div>"
                   if known else "") + "</div>")
        return lines

    def facts(self):
        record, summary = self.record, self.run.summary
        facts = []

        def add(name, content):
            facts.append(f"<div><dt>{name}</dt><dd>{content}</dd></div>")

        if self.run.kind:
            add("scene", quoted(self.run.kind, "parameters.json#/kind"))
        if record.get("started"):
            add("started", quoted(record["started"], "run.json#/started"))
        if self.has_results and summary.get("wall_seconds") is not None:
            add("time", number(summary["wall_seconds"],
                               "summary.json#/wall_seconds", digits=3,
                               unit="s"))
            add("memory", number(summary["peak_memory_mb"],
                                 "summary.json#/peak_memory_mb", digits=3,
                                 unit="MiB"))
        elif record.get("ended"):
            add("ended", quoted(record["ended"], "run.json#/ended"))
        if "ranks" in record:
            add("ranks", number(record["ranks"], "run.json#/ranks"))
            add("abut", quoted(record["abut"], "run.json#/abut"))
            add("deal.II", quoted(record["deal.II"],
                                  f'run.json#{pointer("deal.II")}'))
        lines = [f'<dl class="facts">{"".join(facts)}</dl>']
        if record.get("command"):
            lines.append(
                '<p class="soft reason">To repeat it, in '
                + quoted(record["working_folder"], "run.json#/working_folder",
                         "code") + ":</p>"
                + quoted(record["command"], "run.json#/command", "pre"))
        return "\n".join(lines)


def is_locked(folder):
    """Whether a run is writing into the folder."""
    try:
        with open(folder / ".abut-lock", "rb") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except BlockingIOError:
                return True
            return False
    except OSError:
        return False
