# Reference numbers for tests/analysis from R and pROC (Robin et al., BMC Bioinformatics 12 (2011), 77):
#   cd tests/analysis/reference && Rscript make_reference.R > reference_R.txt
# hit_miss_60.h5: the 60-target set of the US Air Force Research Laboratory's POD 4.5
#   (github.com/AFRL-Material-State-Awareness/POD4.5, HitMissData_Good_1.csv); its results file gives
#   for the logit on size: intercept -11.83265105, slope 45.30678376, a90 0.309663906,
#   AIC 28.45673968 and, by Wald, a90/95 0.381546911.
# hit_miss_levels.h5, features_40.h5: drawn once by this script.
options(digits = 12)
say <- function(name, ...) cat(name, format(c(...), digits = 10), "\n")
tables <- "/usr/bin/python3 ../../reference_tables.py"
read <- function(name) read.csv(pipe(paste(tables, name)))
write <- function(data, name)
  write.csv(data, pipe(paste(tables, name, "'drawn once by R' 'Rscript make_reference.R'")), row.names = FALSE, quote = FALSE)

set.seed(20)
sizes <- c(0.5, 1, 1.5, 2, 3, 4.28)
pod <- 0.05 + (0.97 - 0.05) * plogis(-6 + 3.2 * sizes)
levels <- data.frame(size = sizes, hits = rbinom(6, 400, pod), tests = 400)
if (!file.exists("hit_miss_levels.h5")) write(levels, "hit_miss_levels.h5")
levels <- read("hit_miss_levels.h5")
if (!file.exists("features_40.h5")) {
  faulty <- rep(0:1, each = 20)
  common <- rnorm(40)
  write(data.frame(faulty, a = round(faulty + common + rnorm(40), 1),
                   b = round(0.7 * faulty + common + rnorm(40), 1),
                   c = round(rnorm(40) + 0.3 * faulty, 1)), "features_40.h5")
}

# Upper and lower one-sided 95 % likelihood-ratio bounds of the size with POD p: the curve passes
# through the point (x, p), so that only its slope is free.
crit <- qnorm(0.95)^2
bounds <- function(x, y, n, link, p) {
  fit <- glm(cbind(y, n - y) ~ x, family = binomial(link))
  eta <- family(fit)$linkfun(p)
  at <- unname((eta - coef(fit)[1]) / coef(fit)[2])
  beyond <- function(at) {
    held <- glm(cbind(y, n - y) ~ 0 + I(x - at), offset = rep(eta, length(x)), family = binomial(link),
                start = coef(fit)[2])
    held$deviance - fit$deviance - crit
  }
  c(uniroot(beyond, c(min(x), at), tol = 1e-11)$root, at, uniroot(beyond, c(at, max(x)), tol = 1e-11)$root)
}

targets <- read("hit_miss_60.h5")
for (link in c("logit", "probit")) for (scale in c("size", "log_size")) {
  x <- if (scale == "size") targets$size else log(targets$size)
  fit <- glm(targets$hit ~ x, family = binomial(link), control = list(epsilon = 1e-14))
  back <- if (scale == "size") identity else exp
  name <- paste("targets", link, scale)
  say(paste(name, "coefficients"), coef(fit))
  say(paste(name, "log_likelihood"), logLik(fit))
  say(paste(name, "a50"), back(bounds(x, targets$hit, 1, link, 0.5)))
  say(paste(name, "a90"), back(bounds(x, targets$hit, 1, link, 0.9)))
}

# Floor 0.05 fixed, with and without a free ceiling, by a general optimiser.
curve <- function(theta, x, floor) floor + (theta[3] - floor) * plogis(theta[1] + theta[2] * x)
minus <- function(theta, floor) {
  p <- curve(theta, levels$size, floor)
  -sum(levels$hits * log(p) + (levels$tests - levels$hits) * log(1 - p))
}
best <- function(fn, start) {
  for (i in 1:30) start <- optim(start, fn, method = "Nelder-Mead", control = list(reltol = 1e-16, maxit = 5000))$par
  list(par = start, value = fn(start))
}
plain <- best(function(t) minus(c(t, 1), 0.05), c(-5, 3))
say("levels floor coefficients", plain$par); say("levels floor log_likelihood", -plain$value)
free <- best(function(t) if (t[3] <= 0.06 || t[3] > 1) 1e9 else minus(t, 0.05), c(-5, 3, 0.97))
say("levels ceiling coefficients", free$par); say("levels ceiling log_likelihood", -free$value)
saturated <- sum(dbinom(levels$hits, levels$tests, levels$hits / levels$tests, log = TRUE))
coefficients <- sum(lchoose(levels$tests, levels$hits))
g2 <- 2 * (saturated - coefficients + free$value)
say("levels ceiling G2 p", g2, pchisq(g2, 3, lower.tail = FALSE))
# Profile of a90 with floor and ceiling: slope and ceiling free, the curve through (a, 0.9).
held <- function(a) best(function(t) {
  if (t[2] <= 0.9 || t[2] > 1) return(1e9)
  minus(c(qlogis((0.9 - 0.05) / (t[2] - 0.05)) - t[1] * a, t[1], t[2]), 0.05)
}, c(free$par[2], max(free$par[3], 0.93)))$value
a90 <- (qlogis((0.9 - 0.05) / (free$par[3] - 0.05)) - free$par[1]) / free$par[2]
beyond <- function(a) 2 * (held(a) - free$value) - crit
say("levels ceiling a90", uniroot(beyond, c(a90 - 0.6, a90), tol = 1e-8)$root, a90,
    uniroot(beyond, c(a90, a90 + 0.8), tol = 1e-8)$root)
# Band of the curve with a fixed floor at size 2: eta fixed, slope free.
beyond <- function(eta) 2 * (optimize(function(b) minus(c(eta - 2 * b, b, 1), 0.05), plain$par[2] + c(-2, 2), tol = 1e-10)$objective - plain$value) - crit
eta2 <- plain$par[1] + 2 * plain$par[2]
say("levels floor POD at 2", curve(c(uniroot(beyond, c(eta2 - 1, eta2), tol = 1e-9)$root, 0, 1), 0, 0.05),
    curve(c(eta2, 0, 1), 0, 0.05), curve(c(uniroot(beyond, c(eta2, eta2 + 1), tol = 1e-9)$root, 0, 1), 0, 0.05))

suppressMessages(library(pROC))
features <- read("features_40.h5")
rocs <- lapply(c("a", "b", "c"), function(f) roc(features$faulty, features[[f]], direction = "<", quiet = TRUE))
for (i in 1:3) say(paste("features auc variance", c("a", "b", "c")[i]), auc(rocs[[i]]), var(rocs[[i]], method = "delong"))
for (pair in list(c(1, 2), c(1, 3), c(2, 3))) {
  test <- roc.test(rocs[[pair[1]]], rocs[[pair[2]]], method = "delong", paired = TRUE)
  say(paste(c("features paired", c("a", "b", "c")[pair]), collapse = " "), test$statistic, test$p.value)
}
say("holm", p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm"))

say("clopper_pearson 81/263", binom.test(81, 263)$conf.int)
say("clopper_pearson 1/29", binom.test(1, 29)$conf.int)
say("clopper_pearson 0/20", binom.test(0, 20)$conf.int)
say("order statistic 2000 at 0.05", qbeta(c(0.025, 0.975), 2001 - 1901, 1901))
