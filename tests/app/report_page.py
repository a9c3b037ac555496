"""What a page of `chute report` holds, as any program would find it: its elements, pictures and downloads."""
import base64
import csv
import html.parser
import io
import xml.etree.ElementTree

# Attributes from which a browser fetches something.
ADDRESSES = {"src", "srcset", "href", "poster", "data", "action", "background", "xlink:href"}
EMPTY = {"meta", "link", "img", "source", "input", "br"}


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.elements, self.open, self.texts, self.slips = [], [], [], []
        self.feed(text)
        self.close()
        self.slips += ["<%s> is never closed" % tag for tag in self.open]

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.slips.append("</%s> closes something else" % tag)

    def handle_data(self, data):
        self.texts.append((self.open[-1] if self.open else "", data))

    def text(self):
        return " ".join(data for tag, data in self.texts if tag not in ("script", "style"))

    def style(self):
        return " ".join(data for tag, data in self.texts if tag == "style")

    def addresses(self):
        return [value for _, attributes in self.elements for name, value in attributes.items() if name in ADDRESSES]

    def files(self, kind):
        """The files of that type that stand in data: addresses."""
        return [base64.b64decode(address.split(",", 1)[1], validate=True) for address in self.addresses()
                if address.startswith("data:" + kind)]

    def drawings(self):
        """SVG pictures as trees; xml.etree raises if one is damaged."""
        return [xml.etree.ElementTree.fromstring(file) for file in self.files("image/svg+xml")]

    def downloads(self):
        """Name -> bytes of what can be saved from the page."""
        return {attributes["download"]: base64.b64decode(attributes["href"].split(",", 1)[1])
                for tag, attributes in self.elements if tag == "a" and "download" in attributes}


def rows(table):
    """The rows of a CSV file's bytes as dictionaries."""
    lines = [line for line in table.decode().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(io.StringIO("\n".join(lines))))
