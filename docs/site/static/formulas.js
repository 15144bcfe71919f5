// Sets the formulas of a page, which Sphinx leaves between \\( \\) and \\[ \\].
document.addEventListener("DOMContentLoaded", () => renderMathInElement(document.body));
