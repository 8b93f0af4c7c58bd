#!/usr/bin/env bash
# Makes the corpus (parts, scenes, judged candidates) and fits config/decision.yaml to it: hours of computing.
#   scripts/fit_decision.sh FOLDER [COUNT]    FOLDER: of the corpus; what it holds already is not made again
#                                             COUNT: images per group of five parts and level [8]
# With scenes of your own in the BOP format run `evaluate --dump` on them and give the dumps to fit_decision instead.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[ $# -ge 1 ] || die "which folder? scripts/fit_decision.sh FOLDER [COUNT]"
corpus=$1
count=${2:-8}

install_packages build ros test corpus
build_targets all
[ -e "$corpus/parts/parts.json" ] || /usr/bin/python3 "$root/benchmark/corpus/make_parts.py" --out "$corpus/parts"
for appearance in plain mixed; do
  say "scenes, $appearance"
  /usr/bin/python3 "$root/benchmark/corpus/make_scenes.py" --parts "$corpus/parts" --out "$corpus/$appearance" \
    --programs "$programs" --count "$count" --appearance "$appearance"
done
say "true poses and their twins"
for folder in "$corpus"/*/train_*; do
  [ -e "$folder/twins.csv" ] || "$programs/evaluate" --dataset "$folder" --split dev --proposals truth \
    --out "$folder/truth.csv" --dump "$folder/twins.csv" > "$folder/truth.log"
done

"$programs/fit_decision" "$corpus"/plain/*/dump.csv "$corpus"/mixed/*/dump.csv --out "$root/config/decision.yaml" \
  --source "$(date +%F), $(ls -d "$corpus"/*/train_*/dump.csv | wc -l) data sets of benchmark/corpus, $count images per level"
"$programs/fit_decision" "$corpus"/*/train_*/twins.csv --keep "$root/config/decision.yaml" \
  --out "$root/config/decision.yaml" --source "contests: their true poses and twins"
