"""JavaScript functions for tests of a page within the browser."""

# Function over(svg): texts of a chart whose boxes overlap by more than two pixels in both
# directions. A rotated text is represented by the line through its box's corners, which does not
# overlap rotated neighbours.
OVERLAPS = """
const over = svg => {
    const shown = [...svg.querySelectorAll('text')].filter(t => t.textContent.trim());
    const corners = shown.map(text => {
        const box = text.getBBox(), m = text.getScreenCTM();
        return [[box.x, box.y], [box.x + box.width, box.y],
                [box.x + box.width, box.y + box.height], [box.x, box.y + box.height]]
            .map(([x, y]) => [m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f]);
    });
    // How far two boxes, turned or not, are into each other: the least over their sides' normals.
    const depth = (p, q) => {
        let least = Infinity;
        for (const box of [p, q]) for (const side of [0, 1]) {
            const dx = box[side + 1][0] - box[side][0], dy = box[side + 1][1] - box[side][1];
            const length = Math.hypot(dx, dy);
            if (length === 0) continue;
            const along = c => c.map(([x, y]) => (x * dx + y * dy) / length);
            const a = along(p), b = along(q);
            least = Math.min(least, Math.min(Math.max(...a), Math.max(...b))
                                    - Math.max(Math.min(...a), Math.min(...b)));
        }
        return least;
    };
    // Letters fill about seven tenths of their line's height.
    const found = [];
    for (let i = 0; i < shown.length; ++i) for (let k = i + 1; k < shown.length; ++k) {
        const height = Math.hypot(corners[i][3][0] - corners[i][0][0],
                                  corners[i][3][1] - corners[i][0][1]);
        if (depth(corners[i], corners[k]) > 0.3 * height) {
            found.push(shown[i].textContent + ' | ' + shown[k].textContent);
        }
    }
    return found;
};
"""

# Returns [number of visible texts, those with contrast below AA: 4.5 : 1, or 3 : 1 for large text].
CONTRASTS = """
const numbers = text => (text.match(/[0-9.]+/g) || []).map(Number);
const luminance = rgb => {
    const [r, g, b] = rgb.map(v => v / 255).map(v =>
        v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const ground = element => {
    for (let e = element; e; e = e.parentElement) {
        const colour = numbers(getComputedStyle(e).backgroundColor);
        if (colour.length === 3 || colour[3] > 0.99) return colour.slice(0, 3);
    }
    return [255, 255, 255];
};
const texts = [...document.querySelectorAll('body *')].filter(e => e.checkVisibility()
    && [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim())
    && !['STYLE', 'TITLE', 'DESC'].includes(e.tagName.toUpperCase()));
const weak = [];
let seen = 0;
for (const e of texts) {
    const style = getComputedStyle(e), drawn = e.closest('svg');
    const ink = numbers(drawn ? style.fill : style.color).slice(0, 3);
    // Numbers on a map's squares choose their own ink; test_page.py holds that.
    if (drawn && [[16, 20, 24], [254, 254, 254]].some(own => own.every((v, i) => v === ink[i]))) {
        continue;
    }
    ++seen;
    const pair = [luminance(ink), luminance(ground(drawn || e))].sort((a, b) => a - b);
    const size = parseFloat(style.fontSize), large = size >= 24
        || size >= 18.66 && Number(style.fontWeight) >= 700;
    if ((pair[1] + 0.05) / (pair[0] + 0.05) < (large ? 3 : 4.5)) {
        weak.push(e.textContent.slice(0, 40) + ': ' + ink + ' on ' + ground(drawn || e));
    }
}
return [seen, weak];
"""
