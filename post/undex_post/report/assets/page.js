// Fills the places that the page has for charts and movies, and follows the reader's screen and printer.
function redraw() {
  for (const draw of redraws) draw();
}

const filled = (name, make) => [...document.querySelectorAll(`[data-${name}]`)].map((host) => make(host, Number(host.dataset[name])));
const movies = filled("movie", (host, number) => new Movie(host, page.movies[number]));
const charts = filled("chart", (host, number) => new Chart(host, page.charts[number]));

for (const button of document.querySelectorAll("[data-save]")) {
  button.addEventListener("click", () => {
    const text = document.getElementById(button.dataset.save).textContent;
    const address = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
    element("a", { href: address, download: button.dataset.name }).click();
    URL.revokeObjectURL(address);
  });
}

function print(printing) {
  document.documentElement.classList.toggle("printing", printing);
  redraw();
  if (printing) charts.forEach((chart) => chart.settle());
}
window.addEventListener("beforeprint", () => print(true));
window.addEventListener("afterprint", () => print(false));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);

window.report = { charts, movies, ready: true };
