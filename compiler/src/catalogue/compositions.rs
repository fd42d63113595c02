//! Compositions of Störmer–Verlet by printed weights: the exact weights near the digits are certified.
//!
//! Where a source has the drifts and kicks of such a method, the drifts are the weights. Their papers print them. Those
//! of Kahan & Li and of Sofroniou & Spaletta are also in Hairer, Lubich & Wanner (2006), REBOUND (`integrator_janus.c`),
//! `locuoco/molecular_dynamics` and Huayno (`integrators_shared.c`). Titles and names count the steps of Störmer–Verlet,
//! `s` in Kahan & Li and `m` in McLachlan (1995).

use super::Row;

pub(super) const ROWS: &[Row] = &[
    Row {
        name: "yoshida-1990-order-6-a",
        title: "7 steps of Störmer–Verlet, order 6",
        definition: "base: velocity-verlet, weights: [0.78451361047755726382, 0.23557321335935813369, \
                     -1.17767998417887100695, 1.31518632068391121889], symmetric: true, claim: separable(6)",
        stages: &[8],
        source: "Yoshida, Construction of higher order symplectic integrators, Phys. Lett. A 150 (1990), solution A",
    },
    Row {
        name: "yoshida-1990-order-6-b",
        title: "7 steps of Störmer–Verlet, order 6",
        definition: "base: velocity-verlet, weights: [1.43984816797678309102, 0.00426068187079201616, \
                     -2.13228522200145152088, 2.37635274430775282740], symmetric: true, claim: separable(6)",
        stages: &[8],
        source: "Yoshida, Construction of higher order symplectic integrators, Phys. Lett. A 150 (1990), solution B",
    },
    Row {
        name: "yoshida-1990-order-6-c",
        title: "7 steps of Störmer–Verlet, order 6",
        definition: "base: velocity-verlet, weights: [1.44778256239929793290, -2.14403531630538931060, \
                     0.00152886228424927025338, 2.38944778324368421490], symmetric: true, claim: separable(6)",
        stages: &[8],
        source: "Yoshida, Construction of higher order symplectic integrators, Phys. Lett. A 150 (1990), solution C",
    },
    Row {
        name: "yoshida-1990-order-8-a",
        title: "15 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [1.04242620869970426435, 1.82020630970698006933, \
                     0.157739928123708321343, 2.44002732616634406382, -0.00716989419709533209981, \
                     -2.44699182370424588929, -1.61582374150065378479, -1.7808286265894834253], symmetric: true, claim: \
                     separable(8)",
        stages: &[16],
        source: "Yoshida, Construction of higher order symplectic integrators, Phys. Lett. A 150 (1990), solution A",
    },
    Row {
        name: "yoshida-1990-order-8-b",
        title: "15 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [1.48819229202921310080, -2.33864815101041943098, \
                     2.89105148972198900311, -2.89688250330423987105, 0.00378039588362668223674, \
                     2.89195744315817391244, -0.00169248587771706559145, -3.0755169612012526619], symmetric: true, \
                     claim: separable(8)",
        stages: &[16],
        source: "Yoshida, Construction of higher order symplectic integrators, Phys. Lett. A 150 (1990), solution B",
    },
    Row {
        name: "yoshida-1990-order-8-c",
        title: "15 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [0.629030650210427818049, 1.36934946416874222370, \
                     -1.06458714789183904181, 1.66335809963311356298, -1.67896928259637402925, -1.55946803821449795876, \
                     0.311790812418431890510, 1.6589908845439910692], symmetric: true, claim: separable(8)",
        stages: &[16],
        source: "Yoshida, Construction of higher order symplectic integrators, Phys. Lett. A 150 (1990), solution \
                 C; the print is wrong from the 13th decimal place on",
    },
    Row {
        name: "yoshida-1990-order-8-d",
        title: "15 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [0.914844246229642658287, 0.253693336566286009974, \
                     -1.44485223686030647660, -0.158240635368502468458, 1.93813913762291232471, \
                     -1.96061023297558163691, 0.102799849392219431139, 1.7084530707866603157], symmetric: true, claim: \
                     separable(8)",
        stages: &[16],
        source: "Yoshida, Construction of higher order symplectic integrators, Phys. Lett. A 150 (1990), solution \
                 D; the print is wrong from the 13th decimal place on",
    },
    Row {
        name: "yoshida-1990-order-8-e",
        title: "15 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [1.30300165757516838484, 0.107990467718098279648, \
                     -2.04809795883490205633, 0.00536018921375238082832, -0.0719180053650705075005, \
                     2.52778927318028339169, 0.0227738840126312259937, -2.6937990149999221983], symmetric: true, claim: \
                     separable(8)",
        stages: &[16],
        source: "Yoshida, Construction of higher order symplectic integrators, Phys. Lett. A 150 (1990), solution E",
    },
    Row {
        name: "mclachlan-1995-ss9",
        title: "9 steps of Störmer–Verlet, order 6",
        definition: "base: velocity-verlet, weights: [0.1867, 0.55549702371247839916, 0.12946694891347535806, \
                     -0.84326562338773460855, 0.9432033015235617027], symmetric: true, claim: separable(6)",
        stages: &[10],
        source: "McLachlan, SIAM J. Sci. Comput. 16 (1995), SS, m = 9",
    },
    Row {
        name: "mclachlan-1995-ss15",
        title: "15 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [0.7416703643506129534, -0.4091008258000315940, \
                     0.1907547102962383800, -0.5738624711160822667, 0.2990641813036559238, 0.3346249182452981838, \
                     0.3152930923967665966, -0.796887939352916354], symmetric: true, claim: separable(8)",
        stages: &[16],
        source: "McLachlan, SIAM J. Sci. Comput. 16 (1995), SS, m = 15; Suzuki & Umeno 1993, Kahan & Li 1997 as \
                 s15odr8",
    },
    Row {
        name: "mclachlan-1995-ss17",
        title: "17 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [0.12886597938144329897, 0.5815140871052509624, \
                     -0.41017537146985013753, 0.1851469357165877327, -0.40955234342085141934, 0.14440594108001204106, \
                     0.27833550039367965131, 0.31495668391629485789, -0.626994825405133975], symmetric: true, claim: \
                     separable(8)",
        stages: &[18],
        source: "McLachlan, SIAM J. Sci. Comput. 16 (1995), SS, m = 17",
    },
    Row {
        name: "kahan-li-1997-s9odr6-a",
        title: "9 steps of Störmer–Verlet, order 6",
        definition: "base: velocity-verlet, weights: [0.39216144400731413927925056, 0.33259913678935943859974864, \
                     -0.70624617255763935980996482, 0.08221359629355080023149045, 0.79854399093482996339895035], \
                     symmetric: true, claim: separable(6)",
        stages: &[10],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s9odr6a; the digits are those of Hairer, Lubich & \
                 Wanner, Geometric Numerical Integration, §V.3.2",
    },
    Row {
        name: "kahan-li-1997-s9odr6-b",
        title: "9 steps of Störmer–Verlet, order 6",
        definition: "base: velocity-verlet, weights: [0.39103020330868478817, 0.33403728961113601749, \
                     -0.70622728118756134346, 0.081877549648059445768, 0.79856447723936218406], symmetric: true, claim: \
                     separable(6)",
        stages: &[10],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s9odr6b",
    },
    Row {
        name: "kahan-li-1997-s17odr8-a",
        title: "17 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [0.13020248308889008087881763, 0.56116298177510838456196441, \
                     -0.38947496264484728640807860, 0.15884190655515560089621075, -0.39590389413323757733623154, \
                     0.18453964097831570709183254, 0.25837438768632204729397911, 0.29501172360931029887096624, \
                     -0.60550853383003451169892108], symmetric: true, claim: separable(8)",
        stages: &[18],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s17odr8a; the digits are those of Hairer, Lubich & \
                 Wanner, Geometric Numerical Integration, §V.3.2",
    },
    Row {
        name: "kahan-li-1997-s17odr8-b",
        title: "17 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [0.12713692773487857916, 0.56170253798880269972, \
                     -0.38253471994883018888, 0.16007605629464743119, -0.40181637432680696673, 0.18736671654227849724, \
                     0.26070870920779240570, 0.29039738812516162389, -0.60607448323584816258], symmetric: true, claim: \
                     separable(8)",
        stages: &[18],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s17odr8b",
    },
    Row {
        name: "kahan-li-1997-s31odr10-a",
        title: "31 steps of Störmer–Verlet, order 10",
        definition: "base: velocity-verlet, weights: [-0.48159895600253002870, 0.0036303931544595926879, \
                     0.50180317558723140279, 0.28298402624506254868, 0.80702967895372223806, -0.026090580538592205447, \
                     -0.87286590146318071547, -0.52373568062510581643, 0.44521844299952789252, 0.18612289547097907887, \
                     0.23137327866438360633, -0.52191036590418628905, 0.74866113714499296793, 0.066736511890604057532, \
                     -0.80360324375670830316, 0.91249037635867994571], symmetric: true, claim: separable(10)",
        stages: &[32],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s31odr10a",
    },
    Row {
        name: "kahan-li-1997-s31odr10-b",
        title: "31 steps of Störmer–Verlet, order 10",
        definition: "base: velocity-verlet, weights: [0.27338476926228452782, 0.44587846502560283997, \
                     0.83219642847136307126, -0.83396868554957942879, 0.27891843057015194293, 0.89032738045702532006, \
                     0.056681514845245709418, -0.85737420814978887722, -0.46789492554836586111, \
                     -0.47919009182398264249, 0.16724074680043708909, -0.87443151263376143307, -0.49873481853620165786, \
                     0.58930536608974918851, 0.83458937790882729775, 0.28614352562198582747], symmetric: true, claim: \
                     separable(10)",
        stages: &[32],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s31odr10b",
    },
    Row {
        name: "kahan-li-1997-s33odr10-a",
        title: "33 steps of Störmer–Verlet, order 10",
        definition: "base: velocity-verlet, weights: [0.070428877682658066880, 0.87415651735353949041, \
                     0.055414604963802442707, -0.066800477898797011598, -0.62641308958799555593, \
                     0.23682621087528762872, -0.42221063403170054210, 0.24222942201040859249, 0.047374515478601436594, \
                     0.54386826052472423338, -0.93252230928447264311, 0.16960179883676464855, 0.71608567578450563608, \
                     -0.80016730247310573512, 0.23778185292256770747, -0.32330301550863943389, 0.95529818470370207691], \
                     symmetric: true, claim: separable(10)",
        stages: &[34],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s33odr10a",
    },
    Row {
        name: "kahan-li-1997-s33odr10-b",
        title: "33 steps of Störmer–Verlet, order 10",
        definition: "base: velocity-verlet, weights: [0.12282427644721572094, 0.77644680890696440342, \
                     0.14881514553734297479, -0.17239125953506067249, -0.54745995781852463787, 0.14512932327306927479, \
                     -0.31564555153114460562, 0.12086865089833871979, 0.17910277517866344258, 0.44263408813993245949, \
                     -0.81935337479593697464, 0.13445474141752884045, 0.64444239169016646538, -0.71930149370201612557, \
                     0.21036902497348664610, -0.26908194941570516294, 0.83629272067135846284], symmetric: true, claim: \
                     separable(10)",
        stages: &[34],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s33odr10b",
    },
    Row {
        name: "kahan-li-1997-s33odr10-c",
        title: "33 steps of Störmer–Verlet, order 10",
        definition: "base: velocity-verlet, weights: [0.12313526870982994083, 0.77644981696937310520, \
                     0.14905490079567045613, -0.17250761219393744420, -0.54871240818800177942, 0.14289765421841842100, \
                     -0.31419193263986861997, 0.12670943739561041022, 0.17444734584181312998, 0.44318544665428572929, \
                     -0.81948900568299084419, 0.13382545738489583020, 0.64509023524410605020, -0.71936337169922060719, \
                     0.20951381813463649682, -0.26828113140636051966, 0.83647216092348048955], symmetric: true, claim: \
                     separable(10)",
        stages: &[34],
        source: "Kahan & Li, Composition constants for raising the orders of unconventional schemes for ordinary \
                 differential equations, Math. Comp. 66 (1997), s33odr10c",
    },
    Row {
        name: "sofroniou-spaletta-2005-s11odr6",
        title: "11 steps of Störmer–Verlet, order 6",
        definition: "base: velocity-verlet, weights: [0.21375583945878254555518066964857, \
                     0.18329381407425713911385974425217, 0.17692819473098943794898811709929, \
                     -0.44329082681170215849622829626258, 0.11728560432865935385403585669136, \
                     0.50405474843802736404832781714239], symmetric: true, claim: separable(6)",
        stages: &[12],
        source: "Sofroniou & Spaletta, Derivation of symmetric composition constants for symmetric integrators, \
                 Optim. Methods Softw. 20 (2005), order 6 with 11 stages",
    },
    Row {
        name: "sofroniou-spaletta-2005-s13odr6",
        title: "13 steps of Störmer–Verlet, order 6",
        definition: "base: velocity-verlet, weights: [0.13861930854051695245808013042625, \
                     0.13346562851074760407046858832209, 0.13070531011449225190542755785015, \
                     0.12961893756907034772505366537091, -0.35000324893920896516170830911323, \
                     0.11805530653002387170273438954049, 0.39907751534871587459988795520665], symmetric: true, claim: \
                     separable(6)",
        stages: &[14],
        source: "Sofroniou & Spaletta, Derivation of symmetric composition constants for symmetric integrators, \
                 Optim. Methods Softw. 20 (2005), order 6 with 13 stages",
    },
    Row {
        name: "sofroniou-spaletta-2005-s21odr8",
        title: "21 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [0.10647728984550031823931967854896, \
                     0.10837408645835726397433410591546, 0.35337821052654342419534541324080, \
                     -0.23341414023165082198780281128319, -0.24445266791528841269462171413216, \
                     0.11317848435755633314700952515599, 0.11892905625000350062692972283951, \
                     0.12603912321825988140305670268365, 0.12581718736176041804392391641587, \
                     0.11699135019217642180722881433533, -0.38263596012643665350944670744040], symmetric: true, claim: \
                     separable(8)",
        stages: &[22],
        source: "Sofroniou & Spaletta, Derivation of symmetric composition constants for symmetric integrators, \
                 Optim. Methods Softw. 20 (2005), order 8 with 21 stages",
    },
    Row {
        name: "sofroniou-spaletta-2005-s35odr10",
        title: "35 steps of Störmer–Verlet, order 10",
        definition: "base: velocity-verlet, weights: [0.078795722521686419263907679337684, \
                     0.31309610341510852776481247192647, 0.027918383235078066109520273275299, \
                     -0.22959284159390709415121339679655, 0.13096206107716486317465685927961, \
                     -0.26973340565451071434460973222411, 0.074973343155891435666137105641410, \
                     0.11199342399981020488957508073640, 0.36613344954622675119314812353150, \
                     -0.39910563013603589787862981058340, 0.10308739852747107731580277001372, \
                     0.41143087395589023782070411897608, -0.0048663605831352617621956593099771, \
                     -0.39203335370863990644808193642610, 0.051942502962449647037182904015976, \
                     0.050665090759924496335874344156866, 0.049674370639729879054568800279461, \
                     0.049317735759594537917680008339338], symmetric: true, claim: separable(10)",
        stages: &[36],
        source: "Sofroniou & Spaletta, Derivation of symmetric composition constants for symmetric integrators, \
                 Optim. Methods Softw. 20 (2005), order 10 with 35 stages; Hairer, Lubich & Wanner, Geometric \
                 Numerical Integration, §V.3.2",
    },
    Row {
        name: "morales-2025-y8m10b",
        title: "21 steps of Störmer–Verlet, order 8",
        definition: "base: velocity-verlet, weights: [0.44370228726021218923197141183196, \
                     -0.39443578322284085764474498594073, 0.1464645610975800618712569230326, \
                     0.11575566589480463220616543972403, -0.37349605088056728482635987352576, \
                     0.27793149999039524816733903301747, 0.12231011868707029786561397542663, \
                     0.57503350160061785946141563279891, -0.57896999331780988041471955125778, \
                     0.10467636532245895252340732579853, 0.12205565513615756311730933818828], symmetric: true, claim: \
                     separable(8)",
        stages: &[22],
        source: "Morales, Costa, Pantaleoni, Burgarth, Sanders & Berry, Selection and improvement of product formulae \
                 for best performance of quantum simulation, Quantum Inf. Comput. 25 (2025), table 1, Y8m10b",
    },
    Row {
        name: "morales-2022-y10m16",
        title: "33 steps of Störmer–Verlet, order 10",
        definition: "base: velocity-verlet, weights: [0.081207318210272593225087711441684, \
                     0.20411874474696598289603677693511, 0.66715205827214320371061839297055, \
                     0.15414691779958299150286452215575, -0.15843692473786584550599206557006, \
                     -0.6855442489606141359108973267028, 0.060999140559210408869096992291531, \
                     -0.26441199183146805554735845490359, 0.13064273069786247787208895471461, \
                     0.20218952619073117554714280367018, -0.34622976933123177430694714630668, \
                     0.98855187532756405235733957305613, -0.98828132118546184603769781410676, \
                     0.34781541068705330937913890281003, 0.2904317222970121479878414292093, \
                     -0.4945013179955571856347147977644, 0.62030025850760099919270309219883], symmetric: true, claim: \
                     separable(10)",
        stages: &[34],
        source: "Morales, Costa, Pantaleoni, Burgarth, Sanders & Berry, Greatly improved higher-order product formulae \
                 for quantum simulation, arXiv 2210.15817v2 (2022), order 10 with m = 16",
    },
];
