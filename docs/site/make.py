"""The documentation as a folder of static pages, which need neither a server nor a network.

usage: make.py OUT PROGRAM SYSTEM...     from the top folder; `make site` calls it.  The systems are those of the gallery.
       make.py --check OUT               only looks for links that lead nowhere

The order of the pages is that of the list at the end of README.md.  Pandoc turns each page into HTML; this script adds
navigation, the index of the search (search.js), the pages of the two interfaces (interfaces.py) and the gallery.
The build fails on a link inside the site that leads nowhere.
"""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import urllib.parse

import interfaces

HERE = os.path.dirname(os.path.abspath(__file__))
FORMULAS = "gfm+tex_math_dollars-gfm_auto_identifiers"
MAKERS = {"gallery.md": "Gallery", "api_c.md": "Interface for C", "api_python.md": "Interface for Python"}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def page_name(source):
    """README.md -> index.html, docs/method.md -> method.html."""
    return "index.html" if source == "README.md" else os.path.basename(source)[:-3] + ".html"


def groups_of(readme):
    """[(words of the group, [(source, title)])] of the list under "Documentation"."""
    lines = readme.split("\n## Documentation\n")[1].split("\n## ")[0]
    found = []
    for words, links in re.findall(r"^\* ([^:]+): (.*)$", lines, re.M):
        pages = [(source, title) for title, source in re.findall(r"\[([^]]*)\]\(([^)#]*\.md)\)", links)]
        found.append((words, pages))
    found[0][1].append(("gallery.md", MAKERS["gallery.md"]))
    next(pages for words, pages in found if words == "from programs").extend((s, MAKERS[s]) for s in MAKERS if s.startswith("api"))
    return [("", [("README.md", "Overview")])] + found


def gallery(out, program, systems):
    """A picture, the program's own first sentences and a page of each system."""
    titles = dict(re.findall(r"^ *(\S+) +(.*)$", run([program, "list"]), re.M))
    cards = []
    for name in systems:
        page = os.path.join(out, "gallery", name + ".html")
        os.makedirs(os.path.dirname(page), exist_ok=True)
        said = run([program, "analyze", name, "--html", page])
        heading = said.split("\n\n")[0].split("\n")
        sentence = " ".join(line for line in heading[1:] if not line.startswith(" "))
        cards.append('<a class="card" href="gallery/%s.html"><img src="docs/catalogue/%s.svg" alt="" width="240" height="150"><b>%s</b><span>%s</span></a>'
                     % (name, name, html.escape(titles.get(name, name).strip()), html.escape(sentence)))
    return ("# Gallery\n\nEach picture leads to the page that `nhsym analyze NAME --html FILE` writes: the answer, the motion, and the formulas with their symmetries "
            "and proofs. The [catalogue](docs/catalogue.md) has all shipped systems.\n\n<div class=\"cards\">\n%s\n</div>\n" % "\n".join(cards))


def run(command, text=None):
    done = subprocess.run(command, input=text, capture_output=True, text=True, encoding="utf-8")
    if done.returncode:
        sys.exit("%s failed:\n%s" % (" ".join(command), done.stderr))
    return done.stdout


def converted(texts):
    """The bodies of Markdown pages, {source: text}, by one run of Pandoc, which takes longer to start than to convert a page."""
    marked = "".join("\n\n<!-- page %s -->\n\n%s" % (source, re.sub(r"^<!--.*?-->\n", "", text, flags=re.M)) for source, text in texts.items())
    parts = re.split(r"<!-- page (\S+) -->\n", run(["pandoc", "-f", FORMULAS, "-t", "html5", "--mathml", "--no-highlight", "--wrap=none"], marked))
    return {source: with_anchors(body) for source, body in zip(parts[1::2], parts[2::2])}


def plain(text):
    """What a reader sees of a piece of HTML, on one line; of a formula once."""
    return " ".join(html.unescape(re.sub(r"<annotation.*?</annotation>|<[^>]*>", " ", text, flags=re.S)).split())


def with_anchors(body):
    """Headings get the anchors that GitHub gives them."""
    used = {}

    def heading(m):
        words = html.unescape(re.sub("<[^>]*>", "", m[2]))
        anchor = re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", words.strip().lower()))
        used[anchor] = used.get(anchor, -1) + 1
        return '<h%s id="%s">%s</h%s>' % (m[1], anchor + ("-%d" % used[anchor] if used[anchor] else ""), m[2], m[1])

    return re.sub(r"<h(\d)>(.*?)</h\1>", heading, body, flags=re.S)


def torn(body):
    """A piece of text in which emphasis begins or ends inside of a word, as in a*b + c*d; None: there is none."""
    found = re.search(r"[^<>]*[\w)]<em>[^<]*|<em>[^<]*</em>[\w(][^<]*", body)
    return found and found[0]


def contents_of(body):
    """The headings below the page's own, as a list."""
    links = ['<li class="level%s"><a href="#%s">%s</a></li>' % (level, anchor, html.escape(plain(words))) for level, anchor, words in re.findall(r'<h([23]) id="([^"]*)">(.*?)</h', body, re.S)]
    return '<details open><summary>On this page</summary><ul>%s</ul></details>' % "".join(links) if links else ""


class Site:
    def __init__(self, out, program, systems):
        self.out = out
        self.groups = groups_of(read("README.md"))
        self.order = [page for _, pages in self.groups for page in pages]
        self.titles = dict(self.order)
        forgotten = {"docs/" + name for name in os.listdir("docs") if name.endswith(".md")} - set(self.titles)
        if forgotten:
            sys.exit("README.md, \"Documentation\": no link to %s" % ", ".join(sorted(forgotten)))
        self.texts = {"gallery.md": lambda: gallery(out, program, systems), "api_c.md": interfaces.of_c, "api_python.md": interfaces.of_python}
        self.index = []

    def link(self, source, target):
        """Where a link of a source leads in the site; files that are no pages are copied."""
        target = html.unescape(target)
        if re.match(r"[a-z]+:", target) or target.startswith("#"):
            return target
        path, hash_, anchor = urllib.parse.unquote(target).partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(source), path))
        if path in self.titles:
            return page_name(path) + hash_ + anchor
        if os.path.exists(os.path.join(self.out, path)):
            return path
        if not os.path.isfile(path):
            sys.exit("%s: a link to %s, which does not exist" % (source, target))
        write_to = os.path.join(self.out, path)
        os.makedirs(os.path.dirname(write_to), exist_ok=True)
        shutil.copyfile(path, write_to)
        return path

    def named(self, m):
        """A link whose text is the name of a file gets the page's title, with a capital where a sentence begins."""
        title = self.titles["docs/%s.md" % m[3]]
        begins = (m[1] or "").rstrip(" ") in (".", ":", "<p>", "<li>", "<td>")
        return (m[1] or "") + m[2] + (title[:1].upper() + title[1:] if begins else title) + "</a>"

    def finish(self, source, body):
        """Links, keys of the literature, boxes that scroll, and a link at each heading."""
        body = re.sub(r'(^|[^>\w] |<p>|<li>|<td>)?(<a href="(?:docs/)?([a-z_]+)[.]md">)(?:docs/)?\3[.]md</a>', self.named, body)
        body = re.sub(r'\b(href|src)="([^"]*)"', lambda m: '%s="%s"' % (m[1], html.escape(self.link(source, m[2]))), body)
        if source == "docs/references.md":
            body = re.sub(r"<strong>\[(\w+)\]</strong>", r'<strong id="\1">[\1]</strong>', body)
        else:
            body = re.sub(r"(?<!\w)\[([A-Z][A-Za-z]+\d{4})(?=[],])", r'[<a href="references.html#\1">\1</a>', body)
        body = re.sub(r"<table.*?</table>", lambda m: '<div class="wide">%s</div>' % m[0].replace(
            "<table", '<table class="columns%d"' % min(8, m[0].split("</tr>")[0].count("<th")), 1), body, flags=re.S)
        return re.sub(r'<(h[23]) id="([^"]*)">(.*?)</\1>', r'<\1 id="\2">\3<a class="here" href="#\2" aria-label="link to this section"></a></\1>', body, flags=re.S)

    def add_to_index(self, source, body):
        """One entry for each section: page, anchor, heading, beginning, and all other words."""
        number = [page for page, _ in self.order].index(source)
        for part in re.split(r"(?=<h[123] )", body):
            head = re.match(r'<h(\d) id="([^"]*)">(.*?)</h\1>', part, re.S)
            if not head:
                continue
            text = plain(part[head.end():])
            words = sorted({word for word in re.findall(r"[^\W_][\w'-]*", text.lower()) if len(word) > 2 and not word.isdigit()})
            self.index.append([number, head[2] if head[1] != "1" else "", plain(head[3]), text[:160], " ".join(words)])

    def navigation(self, source):
        parts = []
        for words, pages in self.groups:
            links = ['<li><a href="%s"%s>%s</a></li>' % (page_name(p), ' aria-current="page"' if p == source else "", html.escape(title[:1].upper() + title[1:])) for p, title in pages]
            parts.append("%s<ul>%s</ul>" % ("<h2>%s</h2>" % html.escape(words[:1].upper() + words[1:]) if words else "", "".join(links)))
        return "".join(parts)

    def neighbours(self, source):
        at = [page for page, _ in self.order].index(source)
        link = lambda i, kind, sign: '<a class="%s" href="%s">%s</a>' % (kind, page_name(self.order[i][0]), sign % html.escape(self.order[i][1][:1].upper() + self.order[i][1][1:]))
        return (link(at - 1, "prev", "← %s") if at else "") + (link(at + 1, "next", "%s →") if at + 1 < len(self.order) else "")

    def page(self, source, body):
        self.add_to_index(source, body)
        title = plain(re.search(r"<h1[^>]*>(.*?)</h1>", body, re.S)[1])
        contents = contents_of(body)
        write(os.path.join(self.out, page_name(source)), read(os.path.join(HERE, "page.html")).format(
            title=html.escape(title) + ("" if source == "README.md" else " – nhsym"), navigation=self.navigation(source), body=self.finish(source, body),
            contents=contents, wide="" if contents else " plain", neighbours=self.neighbours(source)))

    def make(self):
        bodies = converted({source: self.texts[source]() if source in self.texts else read(source) for source, _ in self.order})
        for source, _ in self.order:
            if torn(bodies[source]):
                sys.exit("%s: a formula whose * became emphasis; put it between backticks: %s" % (source, torn(bodies[source])))
            self.page(source, bodies[source])
        for name in ("style.css", "search.js"):
            shutil.copyfile(os.path.join(HERE, name), os.path.join(self.out, name))
        shutil.copyfile("src/document/page/font.woff2", os.path.join(self.out, "math.woff2"))
        pages = [[page_name(source), title] for source, title in self.order]
        write(os.path.join(self.out, "index.js"), "nhsymIndex(%s)\n" % json.dumps([pages, self.index], ensure_ascii=False, separators=(",", ":")))


def dead_links(out):
    """Links inside of the site that lead nowhere, as lines."""
    pages = {os.path.relpath(os.path.join(folder, name), out): read(os.path.join(folder, name))
             for folder, _, names in os.walk(out) for name in names if name.endswith(".html")}
    ids = {page: set(re.findall(r'\bid="([^"]*)"', text)) for page, text in pages.items()}
    for page, text in pages.items():
        for target in re.findall(r'<[a-z][^>]*\b(?:href|src)="([^"]*)"', text):
            target = html.unescape(target)
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            path = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            if not os.path.exists(os.path.join(out, path)):
                yield "%s: no file %s" % (page, target)
            elif anchor and anchor not in ids.get(path, {anchor}):
                yield "%s: no anchor %s" % (page, target)


def main(out, *words):
    if out == "--check":
        out = words[0]
    else:
        shutil.rmtree(out, ignore_errors=True)
        Site(out, words[0], words[1:]).make()
    dead = list(dead_links(out))
    if dead:
        sys.exit("links that lead nowhere:\n" + "\n".join(dead))
    print("%s/index.html" % out)


if __name__ == "__main__":
    main(*sys.argv[1:])
