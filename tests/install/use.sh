# use.sh FOLDER: uses the chute of PATH as somebody who has nothing but what was installed; results go to FOLDER, where
# tiny.toml lies.
set -eu
cd "$1"
chute check tiny.toml >/dev/null
chute run tiny.toml -o run --quiet
chute render run --size 320x200 --quiet
chute figure fig-1-06 --quick -o figures --quiet  # a recipe, and text in the fonts
test "$(chute figure --list | wc -l)" -gt 30
for file in run/run.json run/pictures/000004.png figures/fig-1-06.png figures/fig-1-06.pdf figures/fig-1-06.csv; do
  test -s "$file" || { echo "$file was not made"; exit 1; }
done
