import "./parts/app.js";
