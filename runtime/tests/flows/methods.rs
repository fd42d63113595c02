//! Splittings that only these tests have.

symplectic::tableau! {
    pub Leapfrog { base: saba-1 }
    pub Saba2 { base: saba-2 }
    pub Saba3 { base: saba-3 }
    pub Aba1064 { base: blanes-2013-aba-10-6-4 }
    pub BlanesMoan6 { base: blanes-moan-2002-s10 }
}
