// In place of Debian's furo.js, an ES module, which browsers refuse in pages opened from a disk: the theme button.
document.documentElement.classList.remove("no-js");
window.addEventListener("DOMContentLoaded", () => {
  const themes = ["auto", "light", "dark"];
  for (const button of document.getElementsByClassName("theme-toggle"))
    button.addEventListener("click", () => {
      const body = document.body;
      const next = themes[(themes.indexOf(body.dataset.theme) + 1) % themes.length];
      body.dataset.theme = next;
      localStorage.setItem("theme", next);
    });
});
