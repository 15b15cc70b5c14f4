"""A page as a list of blocks, written as Markdown and as HTML."""
import html
import re
from dataclasses import dataclass


@dataclass
class Heading:
    text: str
    level: int = 2


@dataclass
class Text:
    """A paragraph; `code` and **bold** as in Markdown."""
    text: str


@dataclass
class Items:
    texts: list


@dataclass
class Figure:
    file: str
    text: str


@dataclass
class Table:
    header: list
    rows: list

    def cells(self):
        return [[cell if isinstance(cell, str) else show(cell) for cell in row] for row in self.rows]


def show(number):
    """Three digits; nan is an absent value."""
    if number != number:
        return "–"
    return str(number) if isinstance(number, int) else f"{number:.3g}"


def markdown(blocks):
    parts = []
    for block in blocks:
        match block:
            case Heading(text, level):
                parts.append(f"{'#' * level} {text}")
            case Text(text):
                parts.append(text)
            case Items(texts):
                parts.append("\n".join(f"- {text}" for text in texts))
            case Figure(file, text):
                parts.append(f"![{text}]({file})")
            case Table(header, _):
                lines = [header, ["---"] * len(header), *block.cells()]
                parts.append("\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |"
                                       for line in lines))
    return "\n\n".join(parts) + "\n"


STYLE = """body{font:16px/1.5 sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}
img{max-width:100%}table{border-collapse:collapse;font-size:85%;display:block;overflow-x:auto}
td,th{border-bottom:1px solid #ccc;padding:.2rem .6rem;text-align:left}code{background:#f2f2f2}"""


def inline(text):
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text))
    return re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", text)


def line(tag, cells):
    return "<tr>" + "".join(f"<{tag}>{inline(cell)}</{tag}>" for cell in cells) + "</tr>"


def web(blocks, title):
    parts = [f"<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title>"
             f"<style>{STYLE}</style></head><body>"]
    for block in blocks:
        match block:
            case Heading(text, level):
                parts.append(f"<h{level}>{inline(text)}</h{level}>")
            case Text(text):
                parts.append(f"<p>{inline(text)}</p>")
            case Items(texts):
                parts.append("<ul>" + "".join(f"<li>{inline(text)}</li>" for text in texts) + "</ul>")
            case Figure(file, text):
                parts.append(f"<p><img src=\"{file}\" alt=\"{html.escape(text)}\"></p>")
            case Table(header, _):
                parts.append("<table>" + line("th", header) + "".join(line("td", row) for row in block.cells())
                             + "</table>")
    return "\n".join([*parts, "</body></html>"]) + "\n"
